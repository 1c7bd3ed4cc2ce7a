#include "queries/store/detail/relation_selection.h"

#include <utility>

#include "base/propagate.h"

namespace queries {

RelationSelection::RelationSelection(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout,
                                     std::vector<TupleId> ids)
    : database_(std::move(database)),
      layout_(std::move(layout)),
      statement_(database_->statement()),
      ids_(std::move(ids)) {}

Result<TuplePtr> RelationSelection::next() {
  A3D_TRY(database_->check_statement(statement_));
  if (!reader_) {
    time_ = database_->changes().now();
    reader_.emplace(database_, layout_, time_);
  }
  if (database_->changes().is_gone(layout_->table_number(), time_))
    return Error{ErrorCode::wrong_usage, "{}: the relation was replaced or deleted while it was read",
                 layout_->relation()};
  if (position_ == ids_.size()) return TuplePtr();
  const TupleId id = ids_[position_++];
  A3D_ASSIGN(SqliteConnection * source, database_->source_of(*layout_, id, time_));
  A3D_ASSIGN(SqliteStatement statement, source->use(layout_->fetch_sql()));
  statement.bind(1, id);
  A3D_ASSIGN(const bool has_row, statement.step());
  if (!has_row) return Database::missing(*layout_, id);
  A3D_TRY(reader_->take(statement));
  return reader_->tuple();
}

}  // namespace queries
