#include "queries/store/detail/group_writer.h"

#include "base/propagate.h"

namespace queries {

GroupWriter::GroupWriter(Database& database, std::shared_ptr<const RelationLayout> layout)
    : database_(database), layout_(std::move(layout)) {
  for (const AttributeColumns& attribute : layout_->attributes()) builders_.emplace_back(attribute);
}

bool GroupWriter::is_full() const {
  if (ids_.size() >= database_.options().group_rows) return true;
  std::size_t bytes = 0;
  for (const ChunkBuilder& builder : builders_) bytes += builder.byte_count();
  return bytes >= database_.options().group_bytes;
}

Status GroupWriter::add(TupleId id, const Tuple& tuple) {
  if (tuple.attributes.size() != builders_.size())
    return Error{ErrorCode::internal, "a tuple of {} attributes, expected {}", tuple.attributes.size(),
                 builders_.size()}
        .about(layout_->relation());
  // Ids are stored as offsets of 32 bits.
  if (!ids_.empty() && id - ids_.front() > INT32_MAX) A3D_TRY(close());
  for (std::size_t attribute = 0; attribute < builders_.size(); ++attribute) {
    Status status = builders_[attribute].add(tuple.attributes[attribute]);
    if (!status) return std::move(status).error().about(layout_->relation());
  }
  ids_.push_back(id);
  return is_full() ? close() : Status();
}

Status GroupWriter::add(TupleId first_id, const Batch& batch) {
  std::size_t done = 0;
  while (done < batch.rows.count) {
    const std::size_t count = std::min(batch.rows.count - done, database_.options().group_rows - ids_.size());
    std::vector<std::uint32_t> positions;
    positions.reserve(count);
    for (std::size_t i = done; i < done + count; ++i) positions.push_back(static_cast<std::uint32_t>(batch.rows[i]));
    for (std::size_t attribute = 0; attribute < builders_.size(); ++attribute) {
      Status status = builders_[attribute].add(*batch.columns[attribute], {positions.data(), count});
      if (!status) return std::move(status).error().about(layout_->relation());
    }
    for (std::size_t i = done; i < done + count; ++i) ids_.push_back(first_id + static_cast<TupleId>(i));
    done += count;
    if (is_full()) A3D_TRY(close());
  }
  return {};
}

Status GroupWriter::close() {
  if (ids_.empty()) return {};
  std::vector<EncodedChunk> chunks;
  for (const ChunkBuilder& builder : builders_) chunks.push_back(builder.encode());
  A3D_ASSIGN(RowGroup group, database_.row_groups().write(*layout_, ids_, chunks));
  groups_.push_back(std::move(group));
  drop_pending();
  return {};
}

Result<std::vector<Tuple>> GroupWriter::pending() const {
  std::vector<Tuple> tuples;
  for (std::size_t row = 0; row < ids_.size(); ++row) {
    Tuple& tuple = tuples.emplace_back();
    tuple.id = ids_[row];
    for (const ChunkBuilder& builder : builders_) {
      A3D_ASSIGN(Value value, builder.value(row));
      tuple.attributes.push_back(std::move(value));
    }
  }
  return tuples;
}

void GroupWriter::drop_pending() {
  ids_.clear();
  for (ChunkBuilder& builder : builders_) builder.clear();
}

}  // namespace queries
