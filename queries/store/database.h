#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "queries/store/catalogue.h"
#include "queries/store/change_log.h"
#include "queries/store/database_file.h"
#include "queries/store/index_cache.h"
#include "queries/store/kept_rows.h"
#include "queries/store/relation_layout.h"
#include "queries/store/store_options.h"
#include "queries/store/value_cache.h"

namespace queries {

/// A large value in a tuple, as it was when the tuple was read.
struct LargeValue {
  std::shared_ptr<const RelationLayout> layout;
  TupleId tuple = 0;
  std::size_t attribute = 0;  ///< of the relation
  algebra3d::GeometryHeader header;
  std::uint64_t checksum = 0;   ///< of the encoded bytes
  std::uint64_t statement = 0;  ///< in which the tuple was read
  ChangeTime time = 0;          ///< when in it
};

/// What the parts of a store share: the connection, the statement that runs, and what is kept in memory of the file.
/// Owned by the store and by whatever reads lazily; those get errors once their statement is over or the store is
/// closed. Used by one thread, except `load` and `with_bytes`, which several may call while the statement runs.
class Database : public std::enable_shared_from_this<Database> {
 public:
  static Result<std::shared_ptr<Database>> open(const std::filesystem::path& file, OpenMode mode,
                                                const algebra3d::Registry& registry, const StoreOptions& options);
  /// One whose catalogue is damaged, for looking only: it knows the objects that can still be read. Errors: those of a
  /// file that cannot be opened at all.
  static Result<std::shared_ptr<Database>> open_damaged(const std::filesystem::path& file,
                                                        const algebra3d::Registry& registry);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  /// Rolls back and closes the file.
  void close();
  /// What opening did to the file that its user should know; empty: nothing.
  const std::string& opening_notice() const { return opening_notice_; }

  const std::filesystem::path& file() const { return file_; }
  const StoreOptions& options() const { return options_; }
  const algebra3d::Registry& registry() const { return registry_; }

  // Transaction and statement. See Store.
  Status begin_transaction();
  Status commit_transaction();
  Status abort_transaction();
  bool is_in_explicit_transaction() const { return is_explicit_; }
  Status begin(bool writes);
  Status commit();
  void rollback();
  bool is_in_statement() const { return is_in_statement_ && connection_ != nullptr && connection_->in_transaction(); }
  bool has_written() const { return has_written_; }
  /// Its number; another one before and after.
  std::uint64_t statement() const { return statement_; }
  /// Error if it is not the running one.
  Status check_statement(std::uint64_t statement) const;
  /// Error outside a statement.
  Status check_reading() const;
  /// Runs `work`, which changes the database; if it fails the statement can only be rolled back.
  Status change(const std::function<Status()>& work);

  // Within a statement.
  SqliteConnection& connection() { return *connection_; }
  Catalogue& catalogue() { return catalogue_; }
  IndexCache& indexes() { return indexes_; }
  const ChangeLog& changes() const { return changes_; }
  Result<std::shared_ptr<const RelationLayout>> layout_of(const CatalogueEntry& relation);
  /// Before a tuple is erased or overwritten. Errors: those of keeping a copy of it for those who still read it.
  Status note_tuple(const RelationLayout& layout, TupleId tuple);
  void note_inserted(std::int64_t table_number, TupleId tuple) { changes_.note_inserted(table_number, tuple); }
  void note_created(std::int64_t table_number);
  /// Drops the relation's table, with its chunks, at the end of the statement: until then tuples are read from it.
  void drop_at_end(const std::shared_ptr<const RelationLayout>& layout);
  /// Forgets the columns of a table whose relation has another name now.
  void note_renamed(std::int64_t table_number);
  /// The connection through which a tuple is read as it was at `time`. Error if it is neither as it is now nor as it
  /// was when the statement began.
  Result<SqliteConnection*> source_of(const RelationLayout& layout, TupleId tuple, ChangeTime time);

  /// The error of a tuple that is not where `source_of` says.
  static Error missing(const RelationLayout& layout, TupleId tuple);

  // Large values. Errors: database_corrupt, internal after the end of the statement.
  Result<Value> load(const LargeValue& value);
  /// Calls `visit` with the encoded bytes, which live as long as the call; their checksum has been found right.
  Status with_bytes(const LargeValue& value, const std::function<Status(std::string_view)>& visit);
  std::uint64_t geometry_loads() const { return geometry_loads_; }

 private:
  Database(std::unique_ptr<SqliteConnection> connection, std::filesystem::path file,
           const algebra3d::Registry& registry, const StoreOptions& options);
  Status upgrade();
  Status start_statement();
  Status begin_within_transaction();
  void rollback_within_transaction();
  void end_transaction();
  Status write_end();
  Status check_place() const;
  bool is_outdated(const RelationLayout& layout, TupleId tuple) const;
  Status notice_other_processes();
  void forget_everything();
  void end_statement();
  Result<SqliteConnection*> original();
  static Error lost(const RelationLayout& layout, TupleId tuple);
  Result<Value> decode(const LargeValue& value, std::uint64_t& byte_count);

  const std::filesystem::path file_;
  const algebra3d::Registry& registry_;
  const StoreOptions options_;
  std::unique_ptr<SqliteConnection> connection_;
  bool is_read_only_ = false;
  Catalogue catalogue_;
  IndexCache indexes_;
  std::map<std::int64_t, std::shared_ptr<const RelationLayout>> layouts_;
  std::int64_t data_version_ = 0;

  std::string opening_notice_;

  // The transaction over several statements.
  bool is_explicit_ = false;
  bool transaction_has_written_ = false;
  std::optional<Error> lost_transaction_;  // why SQLite has undone it

  // The statement.
  std::uint64_t statement_ = 0;
  bool is_in_statement_ = false;
  bool has_written_ = false;
  std::optional<Error> failure_;
  std::vector<std::shared_ptr<const RelationLayout>> dropped_;

  // What other threads use while they load.
  mutable std::mutex mutex_;
  ChangeLog changes_;
  TransactionLog earlier_;  // the changes of the statements before in this transaction
  ValueCache cache_;
  std::unique_ptr<SqliteConnection> original_;  // sees the database as it was when the transaction began
  KeptRows kept_;                               // rows of this transaction as they were when the statement began
  std::atomic<std::uint64_t> geometry_loads_ = 0;
};

}  // namespace queries
