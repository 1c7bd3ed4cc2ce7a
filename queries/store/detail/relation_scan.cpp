#include "queries/store/detail/relation_scan.h"

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
                           std::vector<bool> read)
    : database_(std::move(database)),
      layout_(std::move(layout)),
      read_(std::move(read)),
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
  return {};
}

Status RelationScan::read_page(std::size_t most) {
  A3D_TRY(database_->check_statement(statement_));
  page_->restart(after_, most);
  position_ = 0;
  if (database_->changes().is_gone(layout_->table_number(), time_))
    return Error{ErrorCode::wrong_usage, "the relation was replaced or deleted while it was read"}.about(
        layout_->relation());
  A3D_TRY(read_rows());
  A3D_TRY(restore_changed());
  page_->finish();
  sum_ += page_->sum();
  after_ = page_end_;
  is_at_end_ = after_ >= last_;
  return is_at_end_ ? check_end() : Status();
}

Status RelationScan::read_rows() {
  if (page_->cells().size() > RowSink::kMaxColumns) return read_wide_rows();
  A3D_ASSIGN(SqliteStatement statement, database_->connection().use(page_sql_));
  statement.bind(1, after_).bind(2, last_).bind(3, *page_);
  A3D_ASSIGN(const bool has_more, statement.step());
  A3D_TRY(page_->status());
  page_end_ = has_more ? page_->last() : last_;
  return {};
}

// Of more columns than a function of SQLite may have arguments.
Status RelationScan::read_wide_rows() {
  A3D_ASSIGN(SqliteStatement statement, database_->connection().use(page_sql_));
  statement.bind(1, after_).bind(2, last_).bind(3, std::numeric_limits<std::int64_t>::max());
  std::vector<Cell> row(page_->cells().size());
  while (!page_->is_full()) {
    A3D_ASSIGN(const bool has_row, statement.step());
    if (!has_row) {
      page_end_ = last_;
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
  return page_->replace(changed, [&](TupleId id, RowReader& reader) -> Status {
    A3D_ASSIGN(SqliteConnection * source, database_->source_of(*layout_, id, time_));
    A3D_ASSIGN(SqliteStatement statement, source->use(layout_->fetch_sql()));
    statement.bind(1, id);
    A3D_ASSIGN(const bool has_row, statement.step());
    if (!has_row) return Database::missing(*layout_, id);
    return reader.take(statement);
  });
}

Status RelationScan::check_end() const {
  if (sum_ == expected_sum_) return {};
  return Error{ErrorCode::database_corrupt, "the tuples that were read are not all those that were written"}.about(
      layout_->relation());
}

}  // namespace queries
