#include "queries/server/detail/result_table.h"

#include <utility>

#include "base/propagate.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

TypeExpr tuple_of(const algebra3d::Type& type) {
  return TypeExpr::tuple({{"value", type.term()}});
}

// Estimated for deferred values: points and triangles with their vertices take less than `kElement`.
std::size_t loaded_bytes(const Tuple& tuple) {
  constexpr std::size_t kElement = 64;
  std::size_t result = heap_bytes(tuple);
  for (const Value& value : tuple.attributes)
    if (value.is_deferred()) result += kElement * value.header().size;
  return result;
}

Status check_limits(const Tuple& tuple, std::size_t bytes_before, const CopyLimits& limits) {
  if (bytes_before + loaded_bytes(tuple) > limits.bytes)
    return Error{ErrorCode::limit_exceeded, "more than {} bytes", limits.bytes};
  for (const Value& value : tuple.attributes)
    if (value.is_deferred() && value.header().size > limits.value_elements)
      return Error{ErrorCode::limit_exceeded, "more than {} elements", limits.value_elements};
  return {};
}

Result<TuplePtr> loaded(const Tuple& tuple) {
  Tuple row{{}, tuple.id};
  for (const Value& value : tuple.attributes) {
    A3D_ASSIGN(Value content, value.loaded());
    row.attributes.push_back(std::move(content));
  }
  return std::make_shared<const Tuple>(std::move(row));
}

}  // namespace

Result<ResultTable> ResultTable::of(std::shared_ptr<Relation> relation) {
  A3D_ASSIGN(const std::int64_t count, relation->count());
  return ResultTable(std::move(relation), static_cast<std::size_t>(count));
}

ResultTable ResultTable::of_value(const Value& value) {
  std::vector<TuplePtr> rows = {std::make_shared<const Tuple>(Tuple{{value}})};
  return {std::make_shared<MemoryRelation>(tuple_of(value.type()), TupleBuffer(std::move(rows))), 1};
}

Result<ResultTable> ResultTable::loaded_copy(const algebra3d::Context& context, algebra3d::WorkMemory& memory,
                                             const CopyLimits& limits, const std::function<Status()>& between) {
  A3D_ASSIGN(const TupleStreamPtr scan, relation_->scan());
  algebra3d::Context within = context;
  within.memory = &memory;
  TupleBuffer rows(within);
  std::size_t bytes = 0;
  A3D_TRY(for_each_tuple(*scan, context, [&](const TuplePtr& tuple) -> Status {
    if (Status fits = check_limits(*tuple, bytes, limits); !fits) return fits;
    A3D_ASSIGN(TuplePtr row, loaded(*tuple));
    bytes += heap_bytes(*row);
    Status added = rows.add(std::move(row));
    return added && between ? between() : added;
  }));
  const std::size_t count = rows.size();
  ResultTable copy(std::make_shared<MemoryRelation>(tuple_type(), std::move(rows)), count);
  copy.copied_bytes_ = bytes;
  copy.levels_ = std::move(levels_);
  return copy;
}

Result<TuplePtr> ResultTable::next_row() {
  A3D_ASSIGN(TuplePtr tuple, scan_->next());
  if (tuple == nullptr) return Error{ErrorCode::internal, "the relation ended at row {} of {}", next_, count_};
  if (next_ == ids_.size() && !relation_->name().empty()) ids_.push_back(tuple->id);
  ++next_;
  return tuple;
}

Result<TuplePtr> ResultTable::row(std::size_t index) {
  if (index < ids_.size() && index != next_) return relation_->fetch(ids_[index]);
  if (scan_ == nullptr || index < next_) {
    A3D_ASSIGN(scan_, relation_->scan());
    next_ = 0;
  }
  while (true) {
    A3D_ASSIGN(TuplePtr tuple, next_row());
    if (next_ > index) return tuple;
  }
}

}  // namespace queries
