#include "queries/streams/batch.h"

#include "algebra3d/values/types/nested_relation.h"
#include "base/propagate.h"

namespace queries {

const algebra3d::Type* type_in_columns(const TypeExpr& type) {
  using algebra3d::TypeOf;
  for (const algebra3d::Type* each :
       {&TypeOf<std::int64_t>::type(), &TypeOf<double>::type(), &TypeOf<bool>::type(), &TypeOf<std::string>::type()})
    if (type.is(each->name())) return each;
  return nullptr;
}

TuplePtr tuple_of(const Batch& batch, std::size_t row) {
  auto tuple = std::make_shared<Tuple>();
  tuple->attributes.reserve(batch.columns.size());
  for (const ValueColumn* column : batch.columns) tuple->attributes.push_back(column->value(row));
  if (batch.ids != nullptr) tuple->id = batch.ids[row];
  return tuple;
}

Result<const Batch*> TupleStream::next_batch(std::size_t /*most*/) {
  return Error{ErrorCode::internal, "a stream without batches was asked for one"};
}

BatchOfTuples::BatchOfTuples(const TypeExpr& tuple, const std::vector<bool>& read) : read_(read) {
  for (const auto& attribute : tuple.attributes()) columns_.emplace_back(*algebra3d::value_type(attribute.type));
  for (const ValueColumn& column : columns_) batch_.columns.push_back(&column);
}

Result<const Batch*> BatchOfTuples::next(TupleStream& tuples, std::size_t most) {
  ids_.clear();
  for (std::size_t attribute = 0; attribute < columns_.size(); ++attribute)
    if (read_[attribute]) columns_[attribute].restart(most);
  while (ids_.size() < most) {
    A3D_ASSIGN(const TuplePtr tuple, tuples.next());
    if (tuple == nullptr) break;
    for (std::size_t attribute = 0; attribute < columns_.size(); ++attribute)
      if (read_[attribute]) columns_[attribute].set(ids_.size(), tuple->attributes[attribute]);
    ids_.push_back(tuple->id);
  }
  if (ids_.empty()) return nullptr;
  batch_.size = ids_.size();
  batch_.ids = ids_.data();
  batch_.rows = {nullptr, ids_.size()};
  return &batch_;
}

}  // namespace queries
