#include "queries/store/detail/stored_tuples.h"

#include <algorithm>

#include "base/propagate.h"

namespace queries {

StoredTuples::StoredTuples(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout,
                           std::vector<bool> read)
    : database_(std::move(database)),
      layout_(std::move(layout)),
      read_(std::move(read)),
      statement_(database_->statement()) {
  std::vector<const algebra3d::Type*> types;
  for (const AttributeColumns& attribute : layout_->attributes()) types.push_back(attribute.type);
  batch_.set_types(types);
}

Status StoredTuples::start() {
  A3D_TRY(database_->check_statement(statement_));
  if (!reader_) {
    time_ = database_->changes().now();
    A3D_ASSIGN(groups_, database_->row_groups().list(*layout_));
    reader_.emplace(database_, layout_, time_);
  }
  if (!database_->changes().is_gone(layout_->table_number(), time_)) return {};
  return Error{ErrorCode::wrong_usage, "the relation was replaced or deleted while it was read"}.about(
      layout_->relation());
}

Result<const Batch*> StoredTuples::read(std::span<const TupleId> ids) {
  // Chunks of which a few tuples are read are kept for the next call; those of many pass by.
  constexpr std::size_t kFew = 256;
  A3D_TRY(start());
  for (std::size_t attribute = 0; attribute < read_.size(); ++attribute)
    if (read_[attribute]) batch_.columns[attribute].restart(ids.size());
  batch_.ids.assign(ids.begin(), ids.end());
  present_.clear();
  A3D_TRY(find(ids));
  const auto group_of = [](const Wanted& each) { return each.group; };
  if (!std::ranges::is_sorted(wanted_, {}, group_of)) std::ranges::stable_sort(wanted_, {}, group_of);
  for (auto begin = wanted_.begin(); begin != wanted_.end();) {
    places_.clear();
    auto end = begin;
    for (; end != wanted_.end() && end->group == begin->group; ++end) places_.push_back(end->place);
    A3D_TRY(read_group((*groups_)[begin->group], places_, ids.size() <= kFew));
    begin = end;
  }
  batch_.finish(ids.size());
  if (present_.size() < ids.size()) batch_.batch.rows = {present_.data(), present_.size()};
  return &batch_.batch;
}

/// Finds the tuples; those of the table are read at once.
Status StoredTuples::find(std::span<const TupleId> ids) {
  wanted_.clear();
  for (std::size_t place = 0; place < ids.size(); ++place) {
    if (const auto found = groups_->find(ids[place])) {
      wanted_.push_back({found->group, {static_cast<std::uint32_t>(found->row), static_cast<std::uint32_t>(place)}});
      present_.push_back(static_cast<std::uint32_t>(place));
    } else {
      A3D_TRY(read_loose(ids[place], place));
    }
  }
  return {};
}

/// Reads a row of the table as it was when this object began.
Status StoredTuples::read_loose(TupleId id, std::size_t place) {
  A3D_ASSIGN(SqliteConnection * source, database_->source_of(*layout_, id, time_));
  A3D_ASSIGN(SqliteStatement statement, source->use(layout_->fetch_sql()));
  statement.bind(1, id);
  A3D_ASSIGN(const bool has_row, statement.step());
  if (!has_row) return {};
  A3D_TRY(reader_->take(statement));
  for (std::size_t attribute = 0; attribute < read_.size(); ++attribute) {
    if (!read_[attribute]) continue;
    A3D_ASSIGN(const Value value, reader_->value(attribute));
    batch_.columns[attribute].set(place, value);
  }
  present_.push_back(static_cast<std::uint32_t>(place));
  return {};
}

Status StoredTuples::read_group(const RowGroup& group, std::span<const RowPlace> places, bool is_kept) {
  RowGroups& groups = database_->row_groups();
  for (std::size_t attribute = 0; attribute < read_.size(); ++attribute) {
    if (!read_[attribute]) continue;
    A3D_ASSIGN(const auto chunk, is_kept ? groups.kept(*layout_, *group.content, attribute)
                                         : groups.read(*layout_, *group.content, attribute));
    A3D_TRY(chunk->read(places, batch_.columns[attribute]));
  }
  return {};
}

}  // namespace queries
