#include "queries/store/detail/relation_filling.h"

#include "base/propagate.h"
#include "queries/store/detail/key_tables.h"

namespace queries {

Result<TuplePtr> tuple_of_group(Database& database, const RelationLayout& layout, const RowGroup& group,
                                std::size_t row) {
  auto tuple = std::make_shared<Tuple>();
  tuple->id = group.content->id(row);
  tuple->attributes.reserve(layout.attributes().size());
  for (std::size_t attribute = 0; attribute < layout.attributes().size(); ++attribute) {
    A3D_ASSIGN(const auto chunk, database.row_groups().kept(layout, *group.content, attribute));
    A3D_ASSIGN(Value value, chunk->value(row));
    tuple->attributes.push_back(std::move(value));
  }
  return TuplePtr(std::move(tuple));
}

Status RelationFilling::add(const Batch& batch) {
  A3D_TRY(writer_.add(next_, batch));
  next_ += static_cast<TupleId>(batch.rows.count);
  return {};
}

Status RelationFilling::add_all(TupleStream& tuples, const algebra3d::Context& context) {
  while (true) {
    A3D_TRY(context.check_cancelled());
    if (tuples.has_batches()) {
      A3D_ASSIGN(const Batch* batch, tuples.next_batch(kBatchTuples));
      if (batch == nullptr) return {};
      A3D_TRY(add(*batch));
    } else {
      A3D_ASSIGN(const TuplePtr tuple, tuples.next());
      if (tuple == nullptr) return {};
      A3D_TRY(add(*tuple));
    }
  }
}

Result<std::vector<Tuple>> RelationFilling::finish(CatalogueEntry& entry) {
  if (entry.next_tuple != first_)
    return Error{ErrorCode::internal, "tuples came into the relation while others were prepared"}.about(
        layout_->relation());
  if (writer_.pending_count() >= database_.options().least_group_rows) A3D_TRY(writer_.close());
  A3D_ASSIGN(std::vector<Tuple> left, writer_.pending());
  writer_.drop_pending();
  groups_ = writer_.take_groups();
  if (groups_.empty()) return left;
  A3D_TRY(move_orders(database_, *layout_));
  for (const RowGroup& group : groups_) {
    entry.tuple_count += group.content->count;
    entry.tuple_sum += group.checksum;
  }
  entry.next_tuple = groups_.back().content->last + 1;
  // What stood behind the last group stands before the new ones: `compact_relations` looks at it.
  database_.forget_loose_rows(layout_->table_number());
  database_.note_loose(layout_->table_number(), {});
  A3D_TRY(database_.row_groups().append(*layout_, groups_));
  return left;
}

}  // namespace queries
