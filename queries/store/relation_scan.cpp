#include "queries/store/relation_scan.h"

#include <algorithm>

namespace queries {
namespace {

constexpr std::int64_t kPageRows = 256;
/// A page ends early when texts and small values fill it.
constexpr std::size_t kPageBytes = std::size_t{4} << 20;

}  // namespace

RelationScan::RelationScan(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout)
    : database_(std::move(database)), layout_(std::move(layout)), statement_(database_->statement()) {}

Result<TuplePtr> RelationScan::next() {
  if (!is_started_) RETURN_IF_ERROR(start());
  while (position_ == page_.size()) {
    if (is_at_end_) return TuplePtr();
    RETURN_IF_ERROR(read_page());
  }
  return page_[position_++].tuple;
}

Status RelationScan::start() {
  RETURN_IF_ERROR(database_->check_statement(statement_));
  const CatalogueEntry* const entry = database_->catalogue().find(layout_->relation());
  if (entry == nullptr || entry->table_number != layout_->table_number())
    return Error{ErrorCode::wrong_usage, "{}: the relation was replaced or deleted before it was read",
                 layout_->relation()};
  time_ = database_->changes().now();
  last_ = entry->next_tuple - 1;
  expected_sum_ = entry->tuple_sum;
  is_started_ = true;
  return {};
}

Status RelationScan::read_page() {
  RETURN_IF_ERROR(database_->check_statement(statement_));
  page_.clear();
  position_ = 0;
  if (database_->changes().is_gone(layout_->table_number(), time_))
    return Error{ErrorCode::wrong_usage, "{}: the relation was replaced or deleted while it was read",
                 layout_->relation()};
  RETURN_IF_ERROR(read_rows());
  RETURN_IF_ERROR(restore_changed());
  for (const Row& row : page_) sum_ += row.checksum;
  after_ = page_end_;
  is_at_end_ = after_ >= last_;
  return is_at_end_ ? check_end() : Status();
}

Status RelationScan::read_rows() {
  ASSIGN_OR_RETURN(SqliteStatement statement, database_->connection().use(layout_->page_sql()));
  statement.bind(1, after_).bind(2, last_).bind(3, kPageRows);
  RowReader reader(database_, layout_, time_);
  std::size_t bytes = 0;
  while (bytes < kPageBytes && page_.size() < kPageRows) {
    ASSIGN_OR_RETURN(const bool has_row, statement.step());
    if (!has_row) {
      page_end_ = last_;
      return {};
    }
    RETURN_IF_ERROR(reader.take(statement));
    ASSIGN_OR_RETURN(TuplePtr tuple, reader.tuple());
    // A damaged tree could lead round in circles.
    if (reader.id() <= (page_.empty() ? after_ : page_.back().tuple->id))
      return Error{ErrorCode::database_corrupt, "{}: the tuples are not in order", layout_->relation()};
    page_.push_back({std::move(tuple), reader.checksum()});
    bytes += reader.byte_count();
  }
  page_end_ = page_.back().tuple->id;
  return {};
}

// Tuples that the statement has erased or overwritten since the scan began are read as they were.
Status RelationScan::restore_changed() {
  const auto changed = database_->changes().changed_tuples(layout_->table_number(), after_, page_end_, time_);
  if (changed.empty()) return {};
  std::erase_if(page_, [&](const Row& row) { return std::ranges::binary_search(changed, row.tuple->id); });
  for (const TupleId id : changed) {
    ASSIGN_OR_RETURN(Row row, row_at_start(id));
    page_.push_back(std::move(row));
  }
  std::ranges::sort(page_, {}, [](const Row& row) { return row.tuple->id; });
  return {};
}

Result<RelationScan::Row> RelationScan::row_at_start(TupleId id) {
  ASSIGN_OR_RETURN(SqliteConnection * source, database_->source_of(*layout_, id, time_));
  ASSIGN_OR_RETURN(SqliteStatement statement, source->use(layout_->fetch_sql()));
  statement.bind(1, id);
  ASSIGN_OR_RETURN(const bool has_row, statement.step());
  if (!has_row) return Database::missing(*layout_, id);
  RowReader reader(database_, layout_, time_);
  RETURN_IF_ERROR(reader.take(statement));
  ASSIGN_OR_RETURN(TuplePtr tuple, reader.tuple());
  return Row{std::move(tuple), reader.checksum()};
}

Status RelationScan::check_end() const {
  if (sum_ == expected_sum_) return {};
  return Error{ErrorCode::database_corrupt, "{}: the tuples that were read are not all those that were written",
               layout_->relation()};
}

}  // namespace queries
