#include "queries/streams/tuple_buffer.h"

#include "queries/streams/mapping.h"

namespace queries {

Status TupleBuffer::add(TuplePtr tuple) {
  tuples_->push_back(std::move(tuple));
  return {};
}

TupleStreamPtr TupleBuffer::scan() const {
  return make_stream([tuples = tuples_, position = std::size_t{0}]() mutable -> Result<TuplePtr> {
    if (position == tuples->size()) return TuplePtr();
    return (*tuples)[position++];
  });
}

RelationPtr TupleBuffer::relation(TypeExpr tuple_type) const {
  return std::make_shared<MemoryRelation>(std::move(tuple_type), tuples_);
}

Result<TupleBuffer> buffered(TupleStream& stream, const Context& context) {
  TupleBuffer buffer;
  RETURN_IF_ERROR(for_each_tuple(stream, context, [&](const TuplePtr& tuple) { return buffer.add(tuple); }));
  return buffer;
}

}  // namespace queries
