#include "queries/server/detail/result_table.h"

#include <utility>

namespace queries {
namespace {

TypeExpr tuple_of(const algebra3d::Type& type) {
  return TypeExpr::tuple({{"value", type.term()}});
}

}  // namespace

Result<ResultTable> ResultTable::of(std::shared_ptr<Relation> relation) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const std::int64_t count, relation->count());
  return ResultTable(std::move(relation), static_cast<std::size_t>(count));
}

ResultTable ResultTable::of_value(const Value& value) {
  std::vector<TuplePtr> rows = {std::make_shared<const Tuple>(Tuple{{value}})};
  return {std::make_shared<MemoryRelation>(tuple_of(value.type()), TupleBuffer(std::move(rows))), 1};
}

Result<ResultTable> ResultTable::loaded_copy(const algebra3d::Context& context) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const TupleStreamPtr scan, relation_->scan());
  std::vector<TuplePtr> rows;
  while (true) {
    ALGEBRA3D_RETURN_IF_ERROR(context.check_cancelled());
    ALGEBRA3D_ASSIGN_OR_RETURN(const TuplePtr tuple, scan->next());
    if (tuple == nullptr) break;
    Tuple row{{}, tuple->id};
    for (const Value& value : tuple->attributes) {
      ALGEBRA3D_ASSIGN_OR_RETURN(Value loaded, value.loaded());
      row.attributes.push_back(std::move(loaded));
    }
    rows.push_back(std::make_shared<const Tuple>(std::move(row)));
  }
  const std::size_t count = rows.size();
  return ResultTable(std::make_shared<MemoryRelation>(tuple_type(), TupleBuffer(std::move(rows))), count);
}

Result<TuplePtr> ResultTable::next_row() {
  ALGEBRA3D_ASSIGN_OR_RETURN(TuplePtr tuple, scan_->next());
  if (tuple == nullptr) return Error{ErrorCode::internal, "the relation ended at row {} of {}", next_, count_};
  if (next_ == ids_.size() && !relation_->name().empty()) ids_.push_back(tuple->id);
  ++next_;
  return tuple;
}

Result<TuplePtr> ResultTable::row(std::size_t index) {
  if (index < ids_.size() && index != next_) return relation_->fetch(ids_[index]);
  if (scan_ == nullptr || index < next_) {
    ALGEBRA3D_ASSIGN_OR_RETURN(scan_, relation_->scan());
    next_ = 0;
  }
  while (true) {
    ALGEBRA3D_ASSIGN_OR_RETURN(TuplePtr tuple, next_row());
    if (next_ > index) return tuple;
  }
}

}  // namespace queries
