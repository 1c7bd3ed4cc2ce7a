#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "base/context.h"
#include "queries/streams/datum.h"
#include "queries/streams/relation.h"
#include "queries/streams/spatial_index.h"

namespace queries {

/// True for the types of index objects: rtree and btree.
inline bool is_index(const TypeExpr& type) {
  return type.is("rtree3") || type.is("btree");
}

/// The catalogue's information about an object.
struct ObjectInfo {
  std::string name;
  TypeExpr type;
  bool has_value = true;             ///< false after `create N : T` until the first `update`
  std::string function_text;         ///< of a function: its text; else empty
  std::string derived_text;          ///< of a derived object: the expression of its value; else empty
  std::string index_relation = {};   ///< of an index that follows a relation: its name; else empty
  std::string index_attribute = {};  ///< of an index: the name of the indexed attribute; else empty
};

/// A name for a type.
struct NamedType {
  std::string name;
  TypeExpr type;
};

enum class OpenMode : std::uint8_t {
  create,      ///< error database_exists if the file is there
  read_write,  ///< error database_missing if it is not
  open_or_create,
  read_only,
  read_damaged,  ///< as read_only; reads the undamaged parts of a damaged file
  draft,         ///< as read_write, for a database that this process creates under an interim name
};

/// A defect of a database.
struct Finding {
  std::string object = {};     ///< name of the object; empty if none is concerned
  TupleId tuple = 0;           ///< of a relation; 0 if none is concerned
  std::string attribute = {};  ///< empty if none is concerned
  std::string message = {};    ///< the defect, without object, tuple and attribute

  /// As one line: `Parts: tuple 3: 'Solid': the bytes are not what was written`.
  std::string text() const;
};

/// Progress of an integrity check.
struct CheckProgress {
  std::string object;       ///< the object that is being checked
  std::uint64_t done = 0;   ///< tuples and values
  std::uint64_t total = 0;  ///< according to the catalogue
};

/// Numbers of changed tuples of stored relations.
struct ChangeCounts {
  std::uint64_t inserted = 0;
  std::uint64_t deleted = 0;
  std::uint64_t updated = 0;
};

/// One open database: a SQLite file in WAL mode (docs/file_format.md, "Database files"). Each relation is a table;
/// other values are in the catalogue or in a table of chunks. Used by one thread. Several processes may open the file:
/// readers never wait, a second writer waits for the first. The changes of a statement (`begin` to `commit`) and of a
/// transaction (`begin_transaction` to `commit_transaction`) are atomic.
class Store {
 public:
  /// Opens a database. Errors: database_missing, database_exists, database_foreign (not an algebra3d database),
  /// database_version (newer), database_corrupt, database_read_only, database_busy, file_missing (no name, no folder
  /// to create it in, no permission to read it), io_error. `create` and `open_or_create` also take an empty file.
  static Result<std::unique_ptr<Store>> open(const std::filesystem::path& file, OpenMode mode,
                                             const algebra3d::Registry& registry);
  virtual ~Store() = default;
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  virtual const std::filesystem::path& file() const = 0;
  /// A notice for the user about what opening did to the file, such as an upgrade; may be empty.
  virtual const std::string& opening_notice() const = 0;

  /// Sets the flag that ends waiting for another writer with the error `interrupted`, within a tenth of a second; null:
  /// none. Without it, waiting ends after StoreOptions::busy_milliseconds with database_busy.
  virtual void end_waiting_when(const std::atomic<bool>* cancel) = 0;

  /// Puts the changes of the write-ahead log into the file and empties the log. Waits until no reader needs the log any
  /// more, `milliseconds` at most, in which nobody can write; new readers need none of it. False if a reader or writer
  /// was in the way to the end, or the store is read-only. To be called outside statements and transactions. Errors:
  /// disk_full, io_error.
  virtual Result<bool> empty_log(int milliseconds) = 0;

  // A transaction over several statements. It holds the write lock from its beginning, unless the store is read-only.
  // Its statements see each other's commits; other processes see them after `commit_transaction`. `abort_transaction`
  // restores the state before it, and so does a failed `commit_transaction`. Some failures (a full disk) make SQLite
  // roll it back early: then `begin` and `commit_transaction` return an error until the transaction has ended. Errors:
  // wrong_usage (there is one already, or none), database_busy, disk_full, io_error.
  virtual Status begin_transaction() = 0;
  virtual Status commit_transaction() = 0;
  virtual Status abort_transaction() = 0;
  virtual bool is_in_explicit_transaction() const = 0;

  // A statement: a transaction of its own, or a part of the running transaction that can be rolled back alone. One at a
  // time. Every change and every `read` happens within a statement: relations and large values that were read are valid
  // until its end and return the error `internal` afterwards. A statement begun without `writes` becomes a writing one
  // with its first change. After a failed change it can only be rolled back. A failed `commit` has rolled back.
  // `rollback` may be called at any time and does not end a transaction over several statements. Errors: database_busy,
  // database_read_only, disk_full.
  virtual Status begin(bool writes) = 0;
  virtual Status commit() = 0;
  virtual void rollback() = 0;
  /// True if the running statement has changed something.
  virtual bool has_written() const = 0;

  // The catalogue. Names are case-sensitive. `objects`, `find` and `is_imported` may be called outside a transaction.
  virtual Result<std::vector<ObjectInfo>> objects() = 0;
  virtual Result<std::optional<ObjectInfo>> find(const std::string& name) = 0;
  /// Creates an object without a value. Errors: name_exists, type_error for a type that cannot be stored.
  virtual Status create(const std::string& name, const TypeExpr& type) = 0;
  /// Creates a derived object, whose value is that of the expression `text` and is assigned like any other.
  virtual Status create_derived(const std::string& name, const TypeExpr& type, const std::string& text) = 0;
  /// Creates a function object.
  virtual Status create_function(const std::string& name, const TypeExpr& type, const std::string& text) = 0;
  /// Replaces the value of an existing object (not a function) by one of exactly its type. A relation may be assigned
  /// another relation or a tuple stream.
  virtual Status assign(const std::string& name, const Datum& value, const algebra3d::Context& context) = 0;
  /// Reads the value of an object that is not a function. Relations are stored relations, which read on demand; indexes
  /// that follow a relation are up to date, and made from its rows if the stored ones are stale, damaged or missing.
  /// Errors: unknown_name, not_evaluable for an object without a value, database_corrupt.
  virtual Result<Datum> read(const std::string& name) = 0;
  /// Removes an object, and with a relation its index definitions.
  virtual Status remove(const std::string& name) = 0;
  /// Removes an object whose value may be damaged. Damaged rows and bytes may stay in the file, unreachable.
  virtual Status kill(const std::string& name) = 0;
  /// Renames an object. Index definitions on a relation are updated, texts of functions and derived objects are not.
  /// Errors: unknown_name, name_exists.
  virtual Status rename(const std::string& from, const std::string& to) = 0;

  // Named types. Their names are independent of those of objects. Reading is allowed outside a transaction.
  virtual Result<std::vector<NamedType>> types() = 0;
  virtual Result<std::optional<TypeExpr>> find_type(const std::string& name) = 0;
  /// Errors: name_exists.
  virtual Status create_type(const std::string& name, const TypeExpr& type) = 0;
  /// Errors: unknown_name.
  virtual Status remove_type(const std::string& name) = 0;

  /// Checks the whole database: SQLite's own structures, the checksum of each row and value, the validity of each
  /// geometry, box and size columns, the stored indexes and those in memory, and that all data belong to an object. An
  /// empty list means that no defect was found. Call within a statement. Memory: one value at a time. Cost: linear in
  /// the file. Errors: interrupted, io_error.
  virtual Result<std::vector<Finding>> check(const algebra3d::Context& context,
                                             const std::function<void(const CheckProgress&)>& progress) = 0;

  /// Checks a database whose catalogue is too damaged to open, as far as it can be read.
  static Result<std::vector<Finding>> check_damaged(const std::filesystem::path& file,
                                                    const algebra3d::Registry& registry,
                                                    const algebra3d::Context& context,
                                                    const std::function<void(const CheckProgress&)>& progress);

  /// Numbers of tuples that operators have changed since the store was opened, including changes that were rolled back.
  /// `assign` does not count.
  virtual ChangeCounts change_counts() const = 0;

  /// Number of geometry blobs read and decoded since the store was opened, for tests that filters read none.
  virtual std::uint64_t geometry_loads() const = 0;
  /// How many faces of large values were read in blocks, without loading the value, since the store was opened.
  virtual std::uint64_t faces_in_blocks() const = 0;

  /// A file that `algebra3d import` has imported into a relation; recorded for resuming.
  struct ImportedFile {
    std::string path;
    std::uint64_t size = 0;
    std::uint64_t hash = 0;
  };
  virtual Result<bool> is_imported(const std::string& relation, const ImportedFile& file) = 0;
  virtual Status remember_imported(const std::string& relation, const ImportedFile& file) = 0;
  /// Forgets that the file at `path` was imported.
  virtual Status forget_imported(const std::string& relation, const std::string& path) = 0;

  /// How much of a table of a server `algebra3d pull` has put into a relation; recorded for resuming.
  struct PulledTable {
    std::string source;          ///< the table
    std::string place = {};      ///< of its last row that was pulled
    std::uint64_t count = 0;     ///< of the rows
    std::uint64_t checksum = 0;  ///< of the rows
  };
  /// What was pulled into the relation, by the names of tables. May be called outside a transaction.
  virtual Result<std::vector<PulledTable>> pulled_tables(const std::string& relation) = 0;
  /// Replaces what is recorded for the same source.
  virtual Status remember_pulled(const std::string& relation, const PulledTable& table) = 0;
  /// Forgets all tables that were pulled into the relation.
  virtual Status forget_pulled(const std::string& relation) = 0;

 protected:
  Store() = default;
};

}  // namespace queries
