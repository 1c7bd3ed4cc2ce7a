// When a Database's statements and transactions begin and end, and which data are dropped then.
#include <algorithm>
#include <new>
#include <utility>

#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "queries/store/detail/chunks.h"
#include "queries/store/detail/compaction.h"
#include "queries/store/detail/database.h"
#include "queries/store/detail/key_tables.h"
#include "queries/store/detail/shape_levels.h"
#include "queries/store/detail/stored_tree.h"
#include "queries/store/detail/tables.h"

namespace queries {
namespace {

constexpr const char* kBeginStatement = "SAVEPOINT statement";
constexpr const char* kEndStatement = "RELEASE statement";
constexpr const char* kUndoStatement = "ROLLBACK TO statement";

/// Writes the face blocks of a value, unless another process has changed or removed it.
Status write_if_there(SqliteConnection& connection, const BlockedValue& value) {
  A3D_ASSIGN(SqliteStatement statement, connection.use(value.presence_sql));
  statement.bind(1, value.place.tuple).bind(2, as_signed(value.checksum));
  A3D_ASSIGN(const bool is_there, statement.step());
  if (!is_there) return {};
  { const SqliteStatement done = std::move(statement); }
  return write_face_blocks(connection, value);
}

}  // namespace

void Database::close() {
  rollback();
  if (is_explicit_) static_cast<void>(abort_transaction());
  forget_everything();
  original_.reset();
  connection_.reset();
}

Status Database::upgrade() {
  if (is_read_only_) return {};
  A3D_ASSIGN(const std::int64_t version, connection_->integer("PRAGMA user_version"));
  if (version >= kLastVersionWithoutPageSums) return {};
  A3D_TRY(connection_->execute("BEGIN IMMEDIATE"));
  // Another process may have been faster.
  const auto found = connection_->integer("PRAGMA user_version");
  Status status = found ? catalogue_.upgrade() : Status(found.error());
  if (status) status = connection_->execute("COMMIT");
  if (status && *found < kLastVersionWithoutPageSums)
    opening_notice_ = fmt::format("{}: the database was upgraded from version {} to {}; older programs cannot open it",
                                  file_.string(), *found, kLastVersionWithoutPageSums);
  if (!status && connection_->in_transaction()) static_cast<void>(connection_->execute("ROLLBACK"));
  catalogue_.forget();
  return status;
}

// It takes the right to write at once: later on, another process could have written meanwhile, and a statement in the
// middle would fail that way.
Status Database::begin_transaction() {
  if (is_explicit_) return Error{ErrorCode::wrong_usage, "a transaction is running already; commit or abort it first"};
  if (is_in_statement_) return Error{ErrorCode::internal, "a statement is running already"}.about(file_.string());
  A3D_TRY(connection_->execute(is_read_only_ ? "BEGIN" : "BEGIN IMMEDIATE"));
  is_explicit_ = true;
  Status status = notice_other_processes();
  if (status) status = catalogue_.load();
  if (!status) static_cast<void>(abort_transaction());
  return status;
}

Status Database::commit_transaction() {
  if (!is_explicit_)
    return Error{ErrorCode::wrong_usage, "no transaction is running; begin one with begin transaction"};
  if (is_in_statement_) return Error{ErrorCode::internal, "a statement is still running"}.about(file_.string());
  Status status = lost_transaction_ ? Status(*lost_transaction_) : connection_->execute("COMMIT");
  if (status) {
    end_transaction();
    return status;
  }
  static_cast<void>(abort_transaction());
  return status;
}

Status Database::abort_transaction() {
  if (!is_explicit_)
    return Error{ErrorCode::wrong_usage, "no transaction is running; begin one with begin transaction"};
  if (is_in_statement_) end_statement();
  // SQLite may have rolled back by itself. If the statement fails, closing the file does the same.
  if (connection_->in_transaction()) static_cast<void>(connection_->execute("ROLLBACK"));
  if (transaction_has_written_) forget_everything();
  end_transaction();
  return {};
}

void Database::end_transaction() {
  const std::lock_guard lock(mutex_);
  is_explicit_ = transaction_has_written_ = false;
  lost_transaction_.reset();
  earlier_.clear();
}

Status Database::begin(bool writes) {
  if (is_in_statement_) return Error{ErrorCode::internal, "a statement is running already"}.about(file_.string());
  if (writes && is_read_only_)
    return Error{ErrorCode::database_read_only, "the database was opened for reading only"}.about(file_.string());
  if (is_explicit_) return begin_within_transaction();
  A3D_TRY(connection_->execute_again(writes ? "BEGIN IMMEDIATE" : "BEGIN"));
  Status status = notice_other_processes();
  if (status) return start_statement();
  rollback();
  return status;
}

Status Database::begin_within_transaction() {
  if (lost_transaction_) return *lost_transaction_;
  A3D_TRY(connection_->execute_again(kBeginStatement));
  return start_statement();
}

Status Database::start_statement() {
  is_in_statement_ = true;
  ++statement_;
  {
    const std::lock_guard lock(mutex_);
    static_cast<void>(cache_.shrink());
  }
  Status status = catalogue_.load();
  if (!status) rollback();
  return status;
}

// The number changes exactly when another connection has committed; reading it fixes what this transaction sees.
Status Database::notice_other_processes() {
  A3D_ASSIGN(const std::int64_t version, connection_->integer("PRAGMA data_version"));
  if (version != data_version_) forget_everything();
  data_version_ = version;
  return {};
}

void Database::forget_everything() {
  const std::lock_guard lock(mutex_);
  catalogue_.forget();
  indexes_.clear();
  row_groups_.forget();
  key_attributes_.clear();
  loose_rows_.clear();
  layouts_.clear();
  cache_.clear();
}

Status Database::commit() {
  Status status = failure_ ? Status(*failure_) : check_reading();
  if (status && has_written_) status = check_place();
  if (status && has_written_) status = write_end();
  if (status) status = end_in_sqlite();
  if (!status) {
    rollback();
    return status;
  }
  transaction_has_written_ = is_explicit_ && (transaction_has_written_ || has_written_);
  if (is_explicit_) earlier_.add(changes_);
  end_statement();
  restore_indexes();
  keep_face_blocks();
  return {};
}

// A statement that only reads has made an index that is missing or damaged. After a failure this is tried again after
// another statement: the answers come from memory meanwhile.
Result<bool> Database::empty_log(int milliseconds) {
  if (is_read_only_ || connection_->in_transaction()) return false;
  connection_->wait_at_most(milliseconds);
  const Result<std::int64_t> is_busy = connection_->integer("PRAGMA wal_checkpoint(TRUNCATE)");
  connection_->wait_at_most(options_.busy_milliseconds);
  if (!is_busy && is_busy.error().code != ErrorCode::database_busy) return is_busy.error();
  return is_busy.ok() && *is_busy == 0;
}

void Database::restore_indexes() {
  if ((orders_to_restore_.empty() && indexes_.unstored().empty()) || is_explicit_ || is_read_only_) return;
  const std::vector<IndexPlace> places = std::exchange(orders_to_restore_, {});
  connection_->wait_at_most(0);
  Status status = connection_->execute("BEGIN IMMEDIATE");
  connection_->wait_at_most(options_.busy_milliseconds);
  if (!status) return;
  status = notice_other_processes();
  if (status) status = catalogue_.load();
  if (status) status = store_trees(*this);
  is_in_statement_ = true;  // the rows are read
  for (const IndexPlace& place : places)
    if (status) status = restore_order(place);
  is_in_statement_ = false;
  if (status) status = connection_->execute("COMMIT");
  if (!status && connection_->in_transaction()) static_cast<void>(connection_->execute("ROLLBACK"));
  if (!status) return;
  for (const IndexPlace& place : places) indexes_.drop_ordered(place.layout->table_number(), place.attribute);
}

// A statement that asked about a large value had to load it whole, and has ended well. Blocks that another writer, a
// full disk, an interrupt or a limit of memory prevents are written when they are asked for again.
void Database::keep_face_blocks() {
  if (values_to_block_.empty()) return;
  const std::vector<BlockedValue> values = std::exchange(values_to_block_, {});
  if (is_explicit_ || is_read_only_) return;
  const auto write = [&]() -> Status {
    connection_->wait_at_most(0);
    const Status begun = connection_->execute("BEGIN IMMEDIATE");
    connection_->wait_at_most(options_.busy_milliseconds);
    A3D_TRY(begun);
    for (const BlockedValue& value : values) A3D_TRY(write_if_there(*connection_, value));
    return connection_->execute("COMMIT");
  };
  try {
    static_cast<void>(algebra3d::as_interrupted(write));
  } catch (const std::bad_alloc&) {
  }
  const algebra3d::UninterruptedScope to_the_end;
  if (connection_->in_transaction()) static_cast<void>(connection_->execute("ROLLBACK"));
}

// SQLite frees the pages of an index along its links, which may lead to pages of others if they are damaged. Then the
// index is left where it is, for `check database` to find.
Status Database::restore_order(const IndexPlace& place) {
  const RelationLayout& layout = *place.layout;
  const auto is_definition = [&](const auto& each) {
    const CatalogueEntry& entry = each.second;
    return entry.type.is("btree") && entry.index_relation == layout.relation() &&
           entry.index_attribute == layout.attributes()[place.attribute].name;
  };
  const CatalogueEntry* const relation = catalogue_.find(layout.relation());
  if (relation == nullptr || relation->table_number != layout.table_number() ||
      std::ranges::none_of(catalogue_.entries(), is_definition))
    return {};
  A3D_ASSIGN(const std::vector<std::size_t>* keys, key_attributes(layout));
  const bool has_keys = std::ranges::find(*keys, place.attribute) != keys->end();
  const std::string& table = has_keys ? layout.keys_table(place.attribute) : layout.table();
  A3D_ASSIGN(SqliteStatement check, connection_->use(fmt::format("PRAGMA quick_check({})", table)));
  A3D_ASSIGN(const bool has_row, check.step());
  if (!has_row || check.column(0).bytes != "ok")
    return Error{ErrorCode::database_corrupt, "the index or the relation is damaged"}.about(layout.relation());
  { const SqliteStatement done = std::move(check); }
  A3D_TRY(drop_order(*this, layout, place.attribute));
  return make_order(shared_from_this(), place.layout, place.attribute);
}

// After it has met damage, SQLite refuses to commit. Where an index was damaged and its answer came from the rows, a
// statement that has only read has nothing to commit.
Status Database::end_in_sqlite() {
  Status status = connection_->execute_again(is_explicit_ ? kEndStatement : "COMMIT");
  const bool may_go_back = !is_explicit_ && !has_written_;
  if (status || !may_go_back || status.error().code != ErrorCode::database_corrupt) return status;
  return connection_->in_transaction() ? connection_->execute("ROLLBACK") : Status();
}

// A file that was removed behind our back would take with it what is written to it now.
Status Database::check_place() const {
  if (!connection_->has_moved()) return {};
  return Error{ErrorCode::io_error,
               "the file of the database was deleted or moved while it was open; the statement is undone"}
      .about(file_.string());
}

Status Database::write_end() {
  for (const auto& layout : dropped_) {
    A3D_TRY(connection_->execute(layout->drop_sql()));
    for (std::size_t attribute = 0; layout->has_columns() && attribute < layout->attributes().size(); ++attribute)
      A3D_TRY(connection_->execute(layout->drop_keys_sql(attribute)));
    A3D_TRY(erase_all_chunks(*connection_, layout->table_number()));
    A3D_TRY(row_groups_.erase_all(layout->table_number()));
  }
  A3D_TRY(compact_relations(*this));
  A3D_TRY(store_trees(*this));
  A3D_TRY(catalogue_.flush());
  return erase_outdated_levels(*this);
}

void Database::rollback() {
  if (connection_ == nullptr) return;
  if (is_explicit_) return rollback_within_transaction();
  if (connection_->in_transaction()) static_cast<void>(connection_->execute("ROLLBACK"));
  if (has_written_) forget_everything();
  end_statement();
}

// After some failures SQLite undoes all of the transaction. Later statements must not run as if nothing had happened.
void Database::rollback_within_transaction() {
  if (!is_in_statement_) return;
  if (connection_->in_transaction() && !(connection_->execute(kUndoStatement) && connection_->execute(kEndStatement)))
    static_cast<void>(connection_->execute("ROLLBACK"));
  if (!connection_->in_transaction() && !lost_transaction_)
    lost_transaction_ =
        Error{failure_ ? failure_->code : ErrorCode::io_error,
              "{}: the transaction was undone when a statement in it failed; use abort transaction, then begin again",
              file_.string()};
  if (has_written_ || lost_transaction_) forget_everything();
  end_statement();
}

void Database::end_statement() {
  const std::lock_guard lock(mutex_);
  ++statement_;
  is_in_statement_ = has_written_ = false;
  failure_.reset();
  dropped_.clear();
  loosened_.clear();
  changes_.clear();
  kept_.clear();
  if (original_ != nullptr && original_->in_transaction() && !original_->execute("COMMIT")) original_.reset();
}

Status Database::check_statement(std::uint64_t statement) const {
  if (is_in_statement() && statement == statement_) return {};
  return Error{ErrorCode::internal, "stored data was used after the end of its statement"}.about(file_.string());
}

Status Database::check_reading() const {
  if (is_in_statement()) return {};
  if (failure_) return *failure_;
  return Error{ErrorCode::internal, "no statement is running"}.about(file_.string());
}

Status Database::change(const std::function<Status()>& work) {
  A3D_TRY(check_reading());
  if (is_read_only_)
    return Error{ErrorCode::database_read_only, "the database was opened for reading only"}.about(file_.string());
  if (failure_) return *failure_;
  has_written_ = true;
  Status status = work();
  if (!status) failure_ = status.error();
  return status;
}

}  // namespace queries
