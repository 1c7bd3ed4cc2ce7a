#include "queries/store/detail/relation_scan.h"

#include <limits>
#include <vector>

#include "base/propagate.h"

namespace queries {

RelationScan::RelationScan(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout)
    : database_(std::move(database)), layout_(std::move(layout)), statement_(database_->statement()), page_(layout_) {}

Result<TuplePtr> RelationScan::next() {
  if (!is_started_) A3D_TRY(start());
  while (position_ == page_.rows().size()) {
    if (is_at_end_) return TuplePtr();
    A3D_TRY(read_page());
  }
  const RowPage::Row& row = page_.rows()[position_++];
  reader_->take(page_.bytes(row), row.checksum);
  return reader_->tuple();
}

Status RelationScan::start() {
  A3D_TRY(database_->check_statement(statement_));
  const CatalogueEntry* const entry = database_->catalogue().find(layout_->relation());
  if (entry == nullptr || entry->table_number != layout_->table_number())
    return Error{ErrorCode::wrong_usage, "{}: the relation was replaced or deleted before it was read",
                 layout_->relation()};
  time_ = database_->changes().now();
  reader_.emplace(database_, layout_, time_);
  last_ = entry->next_tuple - 1;
  expected_sum_ = entry->tuple_sum;
  is_started_ = true;
  return {};
}

Status RelationScan::read_page() {
  A3D_TRY(database_->check_statement(statement_));
  page_.clear(after_);
  position_ = 0;
  if (database_->changes().is_gone(layout_->table_number(), time_))
    return Error{ErrorCode::wrong_usage, "{}: the relation was replaced or deleted while it was read",
                 layout_->relation()};
  A3D_TRY(read_rows());
  A3D_TRY(restore_changed());
  for (const RowPage::Row& row : page_.rows()) sum_ += row.checksum;
  after_ = page_end_;
  is_at_end_ = after_ >= last_;
  return is_at_end_ ? check_end() : Status();
}

Status RelationScan::read_rows() {
  if (layout_->taken_sql().empty()) return read_wide_rows();
  A3D_ASSIGN(SqliteStatement statement, database_->connection().use(layout_->taken_sql()));
  statement.bind(1, after_).bind(2, last_).bind(3, page_);
  A3D_ASSIGN(const bool has_more, statement.step());
  A3D_TRY(page_.status());
  page_end_ = has_more ? page_.rows().back().id : last_;
  return {};
}

// Of more columns than a function of SQLite may have arguments.
Status RelationScan::read_wide_rows() {
  A3D_ASSIGN(SqliteStatement statement, database_->connection().use(layout_->page_sql()));
  statement.bind(1, after_).bind(2, last_).bind(3, std::numeric_limits<std::int64_t>::max());
  std::vector<Cell> row(layout_->small_column_count());
  while (!page_.is_full()) {
    A3D_ASSIGN(const bool has_row, statement.step());
    if (!has_row) {
      page_end_ = last_;
      return {};
    }
    statement.read_columns(row);
    page_.take(row);
    A3D_TRY(page_.status());
  }
  page_end_ = page_.rows().back().id;
  return {};
}

// Tuples that the statement has erased or overwritten since the scan began are read as they were.
Status RelationScan::restore_changed() {
  const auto changed = database_->changes().changed_tuples(layout_->table_number(), after_, page_end_, time_);
  if (changed.empty()) return {};
  page_.erase(changed);
  std::vector<Cell> row(layout_->small_column_count());
  for (const TupleId id : changed) {
    A3D_ASSIGN(SqliteConnection * source, database_->source_of(*layout_, id, time_));
    A3D_ASSIGN(SqliteStatement statement, source->use(layout_->fetch_sql()));
    statement.bind(1, id);
    A3D_ASSIGN(const bool has_row, statement.step());
    if (!has_row) return Database::missing(*layout_, id);
    statement.read_columns(row);
    A3D_TRY(page_.add(row));
  }
  return {};
}

Status RelationScan::check_end() const {
  if (sum_ == expected_sum_) return {};
  return Error{ErrorCode::database_corrupt, "{}: the tuples that were read are not all those that were written",
               layout_->relation()};
}

}  // namespace queries
