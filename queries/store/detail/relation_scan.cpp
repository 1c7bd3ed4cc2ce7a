#include "queries/store/detail/relation_scan.h"

#include <algorithm>
#include <limits>

#include "base/propagate.h"

namespace queries {
namespace {

constexpr std::size_t kPageRows = 256;
/// A page ends early when texts and small values fill it.
constexpr std::size_t kPageBytes = std::size_t{4} << 20;

}  // namespace

void RowPage::clear(TupleId after) {
  // One long text must not keep its memory until the scan ends.
  if (bytes_.capacity() > 2 * kPageBytes) bytes_ = std::string();
  bytes_.clear();
  rows_.clear();
  last_ = after;
  status_ = {};
}

bool RowPage::is_full() const {
  return rows_.size() >= kPageRows || bytes_.size() >= kPageBytes;
}

bool RowPage::take(std::span<Cell> row) {
  const TupleId id = row[0].integer;
  const std::size_t begin = bytes_.size();
  if (!append_proved(row, bytes_)) {
    status_ = damaged_row(*layout_, id);
  } else if (id <= last_) {
    // A damaged tree could lead round in circles.
    status_ = Error{ErrorCode::database_corrupt, "the tuples are not in order"}.about(layout_->relation());
  } else {
    rows_.push_back({id, as_unsigned(row[1].integer), begin});
    last_ = id;
  }
  return !status_.ok() || is_full();
}

Status RowPage::add(std::span<Cell> row) {
  const TupleId id = row[0].integer;
  const std::size_t begin = bytes_.size();
  if (!append_proved(row, bytes_)) return damaged_row(*layout_, id);
  const auto behind = std::ranges::upper_bound(rows_, id, {}, &Row::id);
  rows_.insert(behind, {id, as_unsigned(row[1].integer), begin});
  return {};
}

void RowPage::erase(const std::vector<TupleId>& ids) {
  std::erase_if(rows_, [&](const Row& row) { return std::ranges::binary_search(ids, row.id); });
}

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
    return Error{ErrorCode::wrong_usage, "the relation was replaced or deleted before it was read"}.about(
        layout_->relation());
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
    return Error{ErrorCode::wrong_usage, "the relation was replaced or deleted while it was read"}.about(
        layout_->relation());
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
  return Error{ErrorCode::database_corrupt, "the tuples that were read are not all those that were written"}.about(
      layout_->relation());
}

}  // namespace queries
