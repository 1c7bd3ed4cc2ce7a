#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algebra3d/base/context.h"
#include "algebra3d/registry/registry.h"
#include "queries/streams/datum.h"
#include "queries/streams/relation.h"
#include "queries/streams/spatial_index.h"

namespace queries {

/// Index objects: of boxes or of ordered values.
inline bool is_index(const TypeExpr& type) {
  return type.is("rtree3") || type.is("btree");
}

/// What the catalogue says of one object.
struct ObjectInfo {
  std::string name;
  TypeExpr type;
  bool has_value = true;            ///< false after `create N : T` until the first `update`
  std::string function_text;        ///< of a function: the text that it was written as; else empty
  std::string derived_text;         ///< of a derived object: the expression that its value comes from; else empty
  std::string index_relation = {};  ///< of an index that follows a relation: its name; else empty
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
  read_damaged,  ///< as read_only, as far as a damaged file can be read
  draft,         ///< as read_write, of a database that this process makes under an interim name
};

/// One thing that is wrong with a database.
struct Finding {
  std::string object = {};     ///< name of the object; empty if it is about none
  TupleId tuple = 0;           ///< of a relation; 0 if it is about none
  std::string attribute = {};  ///< empty if it is about none
  std::string message = {};    ///< what is wrong, without these three

  /// As one line: `Parts: tuple 3: 'Solid': the bytes are not what was written`.
  std::string text() const;
};

/// What an integrity check has done so far.
struct CheckProgress {
  std::string object;       ///< what it is looking at
  std::uint64_t done = 0;   ///< tuples and values
  std::uint64_t total = 0;  ///< as many as the catalogue says
};

/// One open database: a SQLite file in WAL mode (design.md §8, docs/file_format.md). Relations are tables, everything
/// else lies in the catalogue or beside it. Used by one thread; several processes may have the file open: readers never
/// wait, a second writer waits for the first one. All changes between `begin` and `commit`, and all those between
/// `begin_transaction` and `commit_transaction`, happen together or, after going back or a crash, not at all.
class Store {
 public:
  /// Errors: database_missing, database_exists, database_foreign (no algebra3d database), database_version (newer),
  /// database_corrupt, database_read_only, database_busy, file_missing (no folder to create it in, no permission to
  /// read it), io_error. `create` and `open_or_create` also take an empty file.
  static Result<std::unique_ptr<Store>> open(const std::filesystem::path& file, OpenMode mode,
                                             const algebra3d::Registry& registry);
  virtual ~Store() = default;
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  virtual const std::filesystem::path& file() const = 0;
  /// What opening has done to the file that its user should know, such as an upgrade to the present format; else empty.
  virtual const std::string& opening_notice() const = 0;

  // A transaction over several statements. From its beginning it holds the right to write, unless the store was opened
  // for reading only, so that no other process makes a statement within it fail; it sees what its statements have
  // committed, others see it after `commit_transaction`. `abort_transaction` goes back to the state before it. A failed
  // `commit_transaction` has done the same. Some failures (a full disk) make SQLite undo it in the middle: then every
  // `begin` and `commit_transaction` gives an error until the transaction has ended.
  // Errors: wrong_usage (there is one already, or none), database_busy, disk_full, io_error.
  virtual Status begin_transaction() = 0;
  virtual Status commit_transaction() = 0;
  virtual Status abort_transaction() = 0;
  virtual bool is_in_explicit_transaction() const = 0;

  // A statement: a transaction of its own, or a part of the one above that can fail for itself. One at a time; every
  // change lies within one, and so does every `read`: relations and large values that come out of it live until its end
  // and give the error `internal` afterwards. A statement begun without `writes` becomes a writing one with its first
  // change. Once a change has failed, it can only be rolled back. A failed `commit` has rolled back; `rollback` does no
  // harm at any time and leaves the transaction over several statements, if there is one.
  // Errors: database_busy, database_read_only, disk_full.
  virtual Status begin(bool writes) = 0;
  virtual Status commit() = 0;
  virtual void rollback() = 0;
  /// True if the running statement has changed something.
  virtual bool has_written() const = 0;

  // The catalogue. Names are case-sensitive. `objects`, `find` and `is_imported` may stand outside a transaction.
  virtual Result<std::vector<ObjectInfo>> objects() = 0;
  virtual Result<std::optional<ObjectInfo>> find(const std::string& name) = 0;
  /// A new object without a value. Errors: name_exists, type_error for a type that cannot be stored.
  virtual Status create(const std::string& name, const TypeExpr& type) = 0;
  /// The same for an object whose value is that of the expression `text`: to be assigned as any value.
  virtual Status create_derived(const std::string& name, const TypeExpr& type, const std::string& text) = 0;
  /// A new function object.
  virtual Status create_function(const std::string& name, const TypeExpr& type, const std::string& text) = 0;
  /// Gives an existing object (not a function) a value of exactly its type, replacing what it had. A relation takes the
  /// tuples of another relation or of a tuple stream.
  virtual Status assign(const std::string& name, const Datum& value, const algebra3d::Context& context) = 0;
  /// The value of an object that is no function. Relations come as stored relations that read as they are pulled, rtree
  /// objects as an up-to-date tree. Errors: unknown_name, not_evaluable for an object without a value,
  /// database_corrupt.
  virtual Result<Datum> read(const std::string& name) = 0;
  /// Removes an object; with a relation go the index definitions on it.
  virtual Status remove(const std::string& name) = 0;
  /// The same for an object whose value may be damaged: its rows and bytes go too if they are sound, and else stay in
  /// the file unseen.
  virtual Status kill(const std::string& name) = 0;
  /// Gives an object another name; index definitions on a relation follow it, texts of functions and of derived objects
  /// do not. Errors: unknown_name, name_exists.
  virtual Status rename(const std::string& from, const std::string& to) = 0;

  // Named types. Their names are apart from those of objects. Reading may stand outside a transaction.
  virtual Result<std::vector<NamedType>> types() = 0;
  virtual Result<std::optional<TypeExpr>> find_type(const std::string& name) = 0;
  /// Errors: name_exists.
  virtual Status create_type(const std::string& name, const TypeExpr& type) = 0;
  /// Errors: unknown_name.
  virtual Status remove_type(const std::string& name) = 0;

  /// Reads everything and proves it: SQLite's own structures, the checksum of each row and value, each geometry as if
  /// it came from elsewhere, box and size columns against the geometry, the indexes in memory against their relations,
  /// and that nothing lies in the file that belongs to no object. An empty list: all is well. Within a statement. It
  /// holds one value at a time. Cost: linear in the file. Errors: interrupted, io_error.
  virtual Result<std::vector<Finding>> check(const algebra3d::Context& context,
                                             const std::function<void(const CheckProgress&)>& progress) = 0;

  /// The same for a database that does not open since its catalogue is damaged: as far as it can be read.
  static Result<std::vector<Finding>> check_damaged(const std::filesystem::path& file,
                                                    const algebra3d::Registry& registry,
                                                    const algebra3d::Context& context,
                                                    const std::function<void(const CheckProgress&)>& progress);

  /// Geometry blobs read and decoded since the store was opened: for tests that filters read none.
  virtual std::uint64_t geometry_loads() const = 0;

  /// Files that `algebra3d import` has taken into a relation: for resuming.
  struct ImportedFile {
    std::string path;
    std::uint64_t size = 0;
    std::uint64_t hash = 0;
  };
  virtual Result<bool> is_imported(const std::string& relation, const ImportedFile& file) = 0;
  virtual Status remember_imported(const std::string& relation, const ImportedFile& file) = 0;
  /// No content of that path counts as imported any more.
  virtual Status forget_imported(const std::string& relation, const std::string& path) = 0;

 protected:
  Store() = default;
};

}  // namespace queries
