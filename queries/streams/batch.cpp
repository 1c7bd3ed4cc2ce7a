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

void gather(const ValueColumn& from, const SelectedRows& rows, ValueColumn& to) {
  if (from.size() == 0) return;
  to.restart(rows.count);
  from.visit([&]<typename Element>(const Element* values) {
    Element* const target = array_of<Element>(to);
    for (std::size_t i = 0; i < rows.count; ++i) target[i] = values[rows[i]];
  });
  if (!from.has_undefined()) return;
  for (std::size_t i = 0; i < rows.count; ++i)
    if (!from.is_defined(rows[i])) to.set_undefined(i);
}

void OwnBatch::set_types(const std::vector<const algebra3d::Type*>& types) {
  if (!columns.empty()) return;
  for (const algebra3d::Type* const type : types) columns.emplace_back(*type);
  for (const ValueColumn& column : columns) batch.columns.push_back(&column);
}

void OwnBatch::finish(std::size_t count) {
  batch.size = count;
  batch.ids = ids.empty() ? nullptr : ids.data();
  batch.rows = {nullptr, count};
}

Result<const Batch*> BatchReader::next(std::size_t most) {
  if (tuples_.has_batches()) return tuples_.next_batch(most);
  // Large tuples end a batch early.
  constexpr std::size_t kMostBytes = std::size_t{1} << 20U;
  own_.ids.clear();
  std::size_t bytes = 0;
  while (own_.ids.size() < most && bytes < kMostBytes) {
    A3D_ASSIGN(const TuplePtr tuple, tuples_.next());
    if (tuple == nullptr) break;
    const std::vector<Value>& values = tuple->attributes;
    if (own_.columns.empty()) {
      std::vector<const algebra3d::Type*> types;
      for (const Value& value : values) types.push_back(&value.type());
      own_.set_types(types);
    }
    for (std::size_t attribute = 0; attribute < values.size(); ++attribute) {
      if (!is_read(attribute)) continue;
      if (own_.ids.empty()) own_.columns[attribute].restart(most);
      own_.columns[attribute].set(own_.ids.size(), values[attribute]);
      bytes += algebra3d::heap_bytes(values[attribute]);
    }
    own_.ids.push_back(tuple->id);
  }
  if (own_.ids.empty()) return nullptr;
  own_.finish(own_.ids.size());
  return &own_.batch;
}

}  // namespace queries
