#pragma once

#include <unordered_set>

#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {

// What the operators that change stored relations have in common. They read all that they need first and write then: a
// relation must not change while it is being read. All of it happens at the first `next` of their result.

/// A stream that `make` makes when it is first asked for a tuple.
template <typename Make>
TupleStreamPtr made_when_asked(Make make) {
  return make_stream([make = std::move(make), stream = TupleStreamPtr()]() mutable -> Result<TuplePtr> {
    if (stream == nullptr) {
      ASSIGN_OR_RETURN(stream, make());
    }
    return stream->next();
  });
}

/// The tuple with its id as a further attribute.
TuplePtr tuple_with_id(const Tuple& tuple, TupleId id);
/// The tuples of a buffer, each with its id as a further attribute.
TupleStreamPtr tuples_with_ids(const TupleBuffer& tuples);

/// The tuple with everything loaded, so that it stays when the stored one goes. It keeps its id.
Result<TuplePtr> loaded_tuple(const Tuple& tuple);

/// Hash over the attributes; of spatial values box and count, so that unequal tuples are told apart without reading
/// geometry.
std::size_t quick_hash(const Tuple& tuple);
/// Equal attribute by attribute. Undefined equals undefined.
Result<bool> are_equal(const Tuple& a, const Tuple& b);

/// The operand's tuples, loaded and each once, which are proved to be those of the relation with their ids.
/// Errors: wrong_usage for a tuple without an id, or one that is not the relation's.
Result<TupleBuffer> own_tuples(TupleStream& tuples, Relation& relation, std::string_view op, const Context& context);

/// The tuple whose id an argument of type tid or int gives, loaded; an empty buffer if there is none.
Result<TupleBuffer> tuple_by_id(const Value& id, Relation& relation);

}  // namespace queries
