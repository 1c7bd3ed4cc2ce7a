#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "queries/store/detail/catalogue.h"
#include "queries/store/detail/change_log.h"
#include "queries/store/detail/database_file.h"
#include "queries/store/detail/index_cache.h"
#include "queries/store/detail/relation_layout.h"
#include "queries/store/detail/row_groups.h"
#include "queries/store/detail/row_snapshot.h"
#include "queries/store/detail/stored_face_blocks.h"
#include "queries/store/detail/value_cache.h"
#include "queries/store/store_options.h"

namespace queries {

/// A reference to a large value of a tuple, as it was when the tuple was read.
struct LargeValue {
  std::shared_ptr<const RelationLayout> layout;
  TupleId tuple = 0;
  std::size_t attribute = 0;  ///< of the relation
  algebra3d::GeometryHeader header;
  std::uint64_t checksum = 0;   ///< of the encoded bytes
  std::uint64_t statement = 0;  ///< number of the statement that read the tuple
  ChangeTime time = 0;          ///< time of reading in this statement
};

/// An attribute of a relation that has an index.
struct IndexPlace {
  std::shared_ptr<const RelationLayout> layout;
  std::size_t attribute = 0;
};

/// The state that the parts of a store share: the connection, the running statement, and the caches. Owned jointly by
/// the store and by streams and values that read lazily; these get errors after the end of their statement or of the
/// store. Used by one thread, except `load` and `with_bytes`, which several threads may call while the statement runs.
class Database : public std::enable_shared_from_this<Database> {
 public:
  static Result<std::shared_ptr<Database>> open(const std::filesystem::path& file, OpenMode mode,
                                                const algebra3d::Registry& registry, const StoreOptions& options);
  /// Opens a database with a damaged catalogue, read-only, with the objects that can still be read. Errors: those of a
  /// file that cannot be opened at all.
  static Result<std::shared_ptr<Database>> open_damaged(const std::filesystem::path& file,
                                                        const algebra3d::Registry& registry);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  /// Rolls back the running transaction and closes the file.
  void close();
  /// A notice for the user about what opening did to the file; may be empty.
  const std::string& opening_notice() const { return opening_notice_; }

  const std::filesystem::path& file() const { return file_; }
  bool is_read_only() const { return is_read_only_; }
  /// A further connection to the file, for reading or for writing; of a database that was opened for reading only it
  /// is for reading in any case. May be called by any thread, also after `close`.
  Result<std::unique_ptr<SqliteConnection>> another_connection(bool writes, int busy_milliseconds) const;
  const StoreOptions& options() const { return options_; }
  const algebra3d::Registry& registry() const { return registry_; }

  // Transactions and statements, as in Store.
  void end_waiting_when(const std::atomic<bool>* cancel) { connection_->end_waiting_when(cancel); }
  Result<bool> empty_log(int milliseconds);
  Status begin_transaction();
  Status commit_transaction();
  Status abort_transaction();
  bool is_in_explicit_transaction() const { return is_explicit_; }
  Status begin(bool writes);
  Status commit();
  void rollback();
  bool is_in_statement() const { return is_in_statement_ && connection_ != nullptr && connection_->in_transaction(); }
  bool has_written() const { return has_written_; }
  /// The number of the running statement. Every statement has its own.
  std::uint64_t statement() const { return statement_; }
  /// Error if `statement` is not the running one.
  Status check_statement(std::uint64_t statement) const;
  /// Error if no statement is running.
  Status check_reading() const;
  /// Runs `work`, which changes the database. If it fails, the statement can only be rolled back.
  Status change(const std::function<Status()>& work);

  // The connection. Call within a statement.
  SqliteConnection& connection() { return *connection_; }
  Catalogue& catalogue() { return catalogue_; }
  IndexCache& indexes() { return indexes_; }
  RowGroups& row_groups() { return row_groups_; }
  /// Whether the file has the tables of row groups, and key tables.
  bool has_row_groups() const { return catalogue_.version() >= kFirstVersionWithRowGroups; }
  /// Whether new tuples of a relation may become row groups: its types allow it, and so does the file.
  bool makes_row_groups(const RelationLayout& layout) const;
  /// Makes SQLite's index of an ordered index anew when the statement has ended, if the file can be written then.
  void restore_order_later(IndexPlace place) { orders_to_restore_.push_back(std::move(place)); }
  /// Keeps the face blocks of a value when the statement has ended, if the file can be written then. May be called by
  /// any thread.
  void keep_face_blocks_later(BlockedValue value);
  /// The number of faces of a value that were read in blocks, since the file was opened. May be called by any thread.
  std::uint64_t block_faces(const LevelPlace& place, std::uint64_t checksum) const;
  void note_block_faces(const LevelPlace& place, std::uint64_t checksum, std::uint64_t count);
  const ChangeLog& changes() const { return changes_; }
  ChangeCounts& change_counts() { return change_counts_; }  // since opening
  /// The attributes of a relation that have a key table.
  Result<const std::vector<std::size_t>*> key_attributes(const RelationLayout& layout);
  void forget_key_attributes(std::int64_t table_number) { key_attributes_.erase(table_number); }

  /// Tuples in the table of a relation that has row groups, or may get some.
  struct LooseRows {
    std::int64_t outside = 0;  ///< before the first row group or behind the last one
    std::int64_t within = 0;
  };
  /// Their numbers, which are counted when they are first asked for. Those of many that have never been in a row group
  /// are not all counted.
  Result<LooseRows> loose_rows(const RelationLayout& layout);
  /// To be called when tuples have come into the table or left it.
  void note_loose(std::int64_t table_number, LooseRows change);
  /// The relations of which `note_loose` was called since, and how many tuples came into their tables.
  std::map<std::int64_t, std::int64_t> take_loosened() { return std::exchange(loosened_, {}); }
  void forget_loose_rows(std::int64_t table_number) { loose_rows_.erase(table_number); }
  Result<std::shared_ptr<const RelationLayout>> layout_of(const CatalogueEntry& relation);
  /// To be called before a tuple is erased or overwritten; copies it if streams may still read it. Errors: those of
  /// copying.
  Status note_tuple(const RelationLayout& layout, TupleId tuple);
  /// As `note_tuple`, for tuples in row groups, ascending: they stay there for streams that have begun.
  void note_group_tuples(std::int64_t table_number, std::span<const TupleId> tuples);
  void note_inserted(std::int64_t table_number, TupleId tuple) { changes_.note_inserted(table_number, tuple); }
  void note_created(std::int64_t table_number);
  /// Drops the table of a relation, with its chunks, at the end of the statement; until then its tuples can be read.
  void drop_at_end(const std::shared_ptr<const RelationLayout>& layout);
  /// To be called when a relation has been renamed, since the columns of its table have other names then.
  void note_renamed(std::int64_t table_number);
  /// The connection that shows a tuple as it was at `time`. Error if the tuple was changed before and after that time.
  Result<SqliteConnection*> source_of(const RelationLayout& layout, TupleId tuple, ChangeTime time);

  /// The error for a tuple that is missing where `source_of` says.
  static Error missing(const RelationLayout& layout, TupleId tuple);

  /// Whether a large value is in memory. May be called by any thread.
  bool is_in_memory(const LargeValue& value);
  // Loads a large value. Errors: database_corrupt; internal after the end of the statement.
  Result<Value> load(const LargeValue& value);
  /// Calls `visit` with the encoded bytes, after checking their checksum. The bytes are valid during the call.
  Status with_bytes(const LargeValue& value, const std::function<Status(std::string_view)>& visit);
  std::uint64_t geometry_loads() const { return geometry_loads_; }
  std::uint64_t faces_in_blocks() const;

 private:
  Database(std::unique_ptr<SqliteConnection> connection, std::filesystem::path file,
           const algebra3d::Registry& registry, const StoreOptions& options);
  Status upgrade();
  Status start_statement();
  Status begin_within_transaction();
  void rollback_within_transaction();
  void end_transaction();
  Status write_end();
  Status end_in_sqlite();
  Status check_place() const;
  bool is_outdated(const RelationLayout& layout, TupleId tuple) const;
  Status notice_other_processes();
  void forget_everything();
  void end_statement();
  Result<SqliteConnection*> original();
  void restore_indexes();
  void keep_face_blocks();
  Status restore_order(const IndexPlace& place);
  static Error lost(const RelationLayout& layout, TupleId tuple);
  Result<Value> decode(const LargeValue& value, std::uint64_t& byte_count);

  const std::filesystem::path file_;
  const algebra3d::Registry& registry_;
  const StoreOptions options_;
  std::unique_ptr<SqliteConnection> connection_;
  const SqliteConnection::Access access_;
  bool is_read_only_ = false;
  Catalogue catalogue_;
  IndexCache indexes_;
  RowGroups row_groups_;
  std::map<std::int64_t, std::shared_ptr<const RelationLayout>> layouts_;
  std::map<std::int64_t, std::vector<std::size_t>> key_attributes_;  // by table number
  std::map<std::int64_t, LooseRows> loose_rows_;
  std::map<std::int64_t, std::int64_t> loosened_;  // by the running statement
  std::int64_t data_version_ = 0;

  std::string opening_notice_;

  // The transaction over several statements.
  bool is_explicit_ = false;
  bool transaction_has_written_ = false;
  std::optional<Error> lost_transaction_;  // the error at which SQLite rolled it back

  // The statement.
  std::uint64_t statement_ = 0;
  bool is_in_statement_ = false;
  bool has_written_ = false;
  std::optional<Error> failure_;
  std::vector<std::shared_ptr<const RelationLayout>> dropped_;
  std::vector<IndexPlace> orders_to_restore_;

  // Used by the threads that load values.
  mutable std::mutex mutex_;
  ChangeLog changes_;
  ChangeCounts change_counts_;
  TransactionLog earlier_;  // the changes of earlier statements of this transaction
  ValueCache cache_;
  std::unique_ptr<SqliteConnection> original_;  // sees the database as it was when the transaction began
  RowSnapshot kept_;                            // rows of this transaction as they were when the statement began
  std::atomic<std::uint64_t> geometry_loads_ = 0;
  std::vector<BlockedValue> values_to_block_;
  std::map<std::pair<LevelPlace, std::uint64_t>, std::uint64_t> block_faces_;  // by place and checksum
};

}  // namespace queries
