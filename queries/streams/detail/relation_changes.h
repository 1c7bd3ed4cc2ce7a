#pragma once

#include <unordered_set>

#include "base/propagate.h"
#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {

// Shared by the operators that change stored relations. At the first `next` of their result they read all input and
// then write, since a relation must not change while it is being read.

/// A stream that calls `make` when its first tuple is pulled, and returns the tuples of the stream made.
template <typename Make>
TupleStreamPtr made_when_asked(Make make) {
  return make_stream([make = std::move(make), stream = TupleStreamPtr()]() mutable -> Result<TuplePtr> {
    if (stream == nullptr) {
      A3D_ASSIGN(stream, make());
    }
    return stream->next();
  });
}

/// The tuple with its id as a further attribute.
TuplePtr tuple_with_id(const Tuple& tuple, TupleId id);
/// The tuples of a buffer, each with its id as a further attribute.
TupleStreamPtr tuples_with_ids(const TupleBuffer& tuples);

/// A copy of the tuple with all values loaded, valid after the stored tuple is erased. It keeps its id.
Result<TuplePtr> loaded_tuple(const Tuple& tuple);

/// Hash of all attributes. Of spatial values it takes box and count only, so no geometry is read.
std::size_t quick_hash(const Tuple& tuple);
/// Whether all attributes are equal. Undefined equals undefined.
Result<bool> are_equal(const Tuple& a, const Tuple& b);

/// The tuples of the operand without duplicates; checks that they are tuples of the relation. They can be read after
/// they were changed in it. Errors: wrong_usage for a tuple without an id or one that differs from that of the
/// relation.
Result<TupleBuffer> own_tuples(TupleStream& tuples, Relation& relation, std::string_view op, const Context& context);

/// The tuple with this id (tid or int), which can be read after it was changed; an empty buffer if there is none.
Result<TupleBuffer> tuple_by_id(const Value& id, Relation& relation);

}  // namespace queries
