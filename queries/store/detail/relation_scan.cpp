#include "queries/store/detail/relation_scan.h"

#include <algorithm>
#include <limits>

#include "base/propagate.h"

namespace queries {
namespace {

constexpr std::size_t kPageRows = 256;

}  // namespace

RelationScan::RelationScan(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout)
    : database_(std::move(database)),
      layout_(std::move(layout)),
      read_(layout_->attributes().size(), true),
      has_batches_(false),
      statement_(database_->statement()) {}

RelationScan::RelationScan(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout,
                           std::vector<bool> read, std::vector<AttributeBounds> bounds)
    : database_(std::move(database)),
      layout_(std::move(layout)),
      read_(std::move(read)),
      bounds_(std::move(bounds)),
      has_batches_(true),
      statement_(database_->statement()) {}

Result<TuplePtr> RelationScan::next() {
  A3D_ASSIGN(const bool has_tuple, read_tuples(kPageRows));
  if (!has_tuple) return TuplePtr();
  const Batch& batch = page_->batch();
  return tuple_of(batch, batch.rows[position_++]);
}

Result<const Batch*> RelationScan::next_batch(std::size_t most) {
  A3D_ASSIGN(const bool has_tuple, read_tuples(most));
  if (!has_tuple) return nullptr;
  const Batch& batch = position_ == 0 ? page_->batch() : page_->rest(position_);
  position_ = batch.rows.count;
  return &batch;
}

/// Reads a page if all tuples have been given; false at the end.
Result<bool> RelationScan::read_tuples(std::size_t most) {
  if (!page_) A3D_TRY(start());
  while (position_ == page_->batch().rows.count) {
    if (is_at_end_) return false;
    A3D_TRY(read_page(most));
  }
  return true;
}

Status RelationScan::start() {
  A3D_TRY(database_->check_statement(statement_));
  const CatalogueEntry* const entry = database_->catalogue().find(layout_->relation());
  if (entry == nullptr || entry->table_number != layout_->table_number())
    return Error{ErrorCode::wrong_usage, "the relation was replaced or deleted before it was read"}.about(
        layout_->relation());
  time_ = database_->changes().now();
  last_ = entry->next_tuple - 1;
  expected_sum_ = entry->tuple_sum;
  page_.emplace(database_, layout_, read_, !has_batches_ || !database_->connection().proves_pages(), time_);
  page_sql_ = layout_->page_sql(page_->cells());
  A3D_ASSIGN(groups_, database_->row_groups().list(*layout_));
  sum_ = groups_->sum();
  is_whole_ = after_ == 0;
  while (group_ < groups_->size() && (*groups_)[group_].content->last <= after_) ++group_;
  return find_loose();
}

Status RelationScan::find_loose() {
  if (groups_->is_empty()) return {};
  A3D_ASSIGN(SqliteStatement rows, database_->connection().use(layout_->ids_sql()));
  rows.bind(1, (*groups_)[0].content->first).bind(2, groups_->last());
  while (true) {
    A3D_ASSIGN(const bool has_row, rows.step());
    if (!has_row) return {};
    loose_.push_back(rows.column(0).integer);
  }
}

Status RelationScan::read_page(std::size_t most) {
  A3D_TRY(database_->check_statement(statement_));
  page_->restart(after_, most);
  position_ = 0;
  if (database_->changes().is_gone(layout_->table_number(), time_))
    return Error{ErrorCode::wrong_usage, "the relation was replaced or deleted while it was read"}.about(
        layout_->relation());
  const bool has_group = group_ < groups_->size();
  table_end_ = has_group ? (*groups_)[group_].content->first - 1 : last_;
  A3D_TRY(has_group && after_ >= table_end_ ? read_group(most) : read_table());
  page_->finish();
  sum_ += page_->sum();
  after_ = page_end_;
  is_at_end_ = after_ >= last_;
  return is_at_end_ ? check_end() : Status();
}

/// Reads rows of the table, before the next row group.
Status RelationScan::read_table() {
  while (loose_position_ < loose_.size() && loose_[loose_position_] <= table_end_) ++loose_position_;
  A3D_TRY(read_rows());
  return restore_changed();
}

/// Reads a part of a row group. A tuple that stands in the table has a row in it, which is dead.
Status RelationScan::read_group(std::size_t most) {
  const RowGroup& group = (*groups_)[group_];
  if (group_row_ == 0 && may_leave_out(group, most)) {
    page_->take_none();
    group_row_ = group.content->count;
    page_end_ = group.content->last;
    ++left_out_;
  } else {
    if (group_row_ == 0) A3D_TRY(read_chunks(group));
    const std::size_t count = std::min(most, group.content->count - group_row_);
    A3D_TRY(page_->take_group(group, chunks_, group_row_, count));
    group_row_ += count;
    page_end_ = page_->last();
  }
  if (group_row_ == group.content->count) {
    ++group_;
    group_row_ = 0;
  }
  return read_beside();
}

/// Reads the tuples that stand beside the part of a row group: all at once if the statement has changed nothing since
/// the scan began.
Status RelationScan::read_beside() {
  std::vector<TupleId> beside;
  while (loose_position_ < loose_.size() && loose_[loose_position_] <= page_end_)
    beside.push_back(loose_[loose_position_++]);
  if (beside.empty()) return {};
  if (database_->changes().now() != time_ || page_->cells().size() > RowSink::kMaxColumns)
    return page_->add(beside, [&](TupleId id, RowReader& reader) { return fetch(id, reader); });
  page_->begin_beside(beside.size(), beside.front() - 1);
  for (bool has_more = true; has_more && page_->last() < beside.back();) {
    A3D_ASSIGN(SqliteStatement statement, database_->connection().use(page_sql_));
    statement.bind(1, page_->last()).bind(2, beside.back()).bind(3, *page_);
    A3D_ASSIGN(has_more, statement.step());
    A3D_TRY(page_->status());
  }
  if (page_->end_beside(beside)) return {};
  return Error{ErrorCode::database_corrupt, "the tuples that were read are not all those that were written"}.about(
      layout_->relation());
}

/// Whether no value of a group is within the bounds. The tuples beside it are read, and must fit into a page.
bool RelationScan::may_leave_out(const RowGroup& group, std::size_t most) const {
  if (group.dead_count > most) return false;
  return std::ranges::any_of(bounds_, [&](const AttributeBounds& each) {
    return !group.content->columns[each.attribute].range.meets(each.low, each.high);
  });
}

std::vector<StageCount> RelationScan::stages() const {
  if (left_out_ == 0) return {};
  return {{"row groups left out", left_out_}};
}

Status RelationScan::read_chunks(const RowGroup& group) {
  chunks_.clear();
  for (const std::size_t attribute : page_->attributes()) {
    A3D_ASSIGN(auto chunk, database_->row_groups().read(*layout_, *group.content, attribute));
    chunks_.push_back(std::move(chunk));
  }
  return {};
}

/// Reads a row of the table as it was when the scan began.
Status RelationScan::fetch(TupleId id, RowReader& reader) const {
  A3D_ASSIGN(SqliteConnection * source, database_->source_of(*layout_, id, time_));
  A3D_ASSIGN(SqliteStatement statement, source->use(layout_->fetch_sql()));
  statement.bind(1, id);
  A3D_ASSIGN(const bool has_row, statement.step());
  if (!has_row) return Database::missing(*layout_, id);
  return reader.take(statement);
}

Status RelationScan::read_rows() {
  if (page_->cells().size() > RowSink::kMaxColumns) return read_wide_rows();
  A3D_ASSIGN(SqliteStatement statement, database_->connection().use(page_sql_));
  statement.bind(1, after_).bind(2, table_end_).bind(3, *page_);
  A3D_ASSIGN(const bool has_more, statement.step());
  A3D_TRY(page_->status());
  page_end_ = has_more ? page_->last() : table_end_;
  return {};
}

// Of more columns than a function of SQLite may have arguments.
Status RelationScan::read_wide_rows() {
  A3D_ASSIGN(SqliteStatement statement, database_->connection().use(page_sql_));
  statement.bind(1, after_).bind(2, table_end_).bind(3, std::numeric_limits<std::int64_t>::max());
  std::vector<Cell> row(page_->cells().size());
  while (!page_->is_full()) {
    A3D_ASSIGN(const bool has_row, statement.step());
    if (!has_row) {
      page_end_ = table_end_;
      return {};
    }
    statement.read_columns(row);
    page_->take(row);
    A3D_TRY(page_->status());
  }
  page_end_ = page_->last();
  return {};
}

// Tuples that the statement has erased or overwritten since the scan began are read as they were.
Status RelationScan::restore_changed() {
  const auto changed = database_->changes().changed_tuples(layout_->table_number(), after_, page_end_, time_);
  if (changed.empty()) return {};
  return page_->replace(changed, [&](TupleId id, RowReader& reader) { return fetch(id, reader); });
}

Status RelationScan::check_end() const {
  if (!is_whole_ || sum_ == expected_sum_) return {};
  return Error{ErrorCode::database_corrupt, "the tuples that were read are not all those that were written"}.about(
      layout_->relation());
}

}  // namespace queries
