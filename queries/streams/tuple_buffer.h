#pragma once

#include <memory>
#include <vector>

#include "queries/streams/relation.h"

namespace queries {

/// Tuples put aside to be read again, in the order in which they came. First filled, then read any number of times;
/// what was filled stays as it is while a scan lives. All operators that keep tuples keep them here, or in `sorted`,
/// `HashTable` and `materialise`.
class TupleBuffer {
 public:
  Status add(TuplePtr tuple);
  std::size_t size() const { return tuples_->size(); }
  bool is_empty() const { return tuples_->empty(); }
  TupleStreamPtr scan() const;
  /// A relation of these tuples, which keep the ids that they came with.
  RelationPtr relation(TypeExpr tuple_type) const;

 private:
  std::shared_ptr<std::vector<TuplePtr>> tuples_ = std::make_shared<std::vector<TuplePtr>>();
};

/// Everything that comes out of a stream. Errors: those of the stream, interrupted.
Result<TupleBuffer> buffered(TupleStream& stream, const algebra3d::Context& context);

}  // namespace queries
