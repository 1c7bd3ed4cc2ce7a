#pragma once

#include <filesystem>
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

/// What the catalogue says of one object.
struct ObjectInfo {
  std::string name;
  TypeExpr type;
  bool has_value = true;      ///< false after `create N : T` until the first `update`
  std::string function_text;  ///< of a function: the text that it was written as; else empty
};

enum class OpenMode : std::uint8_t {
  create,      ///< error database_exists if the file is there
  read_write,  ///< error database_missing if it is not
  open_or_create,
  read_only,
};

/// One open database: a SQLite file in WAL mode (design.md §8, docs/file_format.md). Relations are tables, everything
/// else lies in the catalogue or beside it. Used by one thread; several processes may have the file open. All changes
/// between `begin` and `commit` happen together or, after `rollback` or a crash, not at all.
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

  // One transaction at a time; every change lies within one, and so does every `read`: relations and large values that
  // come out of it live until its end and give the error `internal` afterwards. A transaction begun without `writes`
  // becomes a writing one with its first change. Once a change has failed, it can only be rolled back. A failed
  // `commit` has rolled back; `rollback` does no harm at any time.
  // Errors: database_busy, database_read_only, disk_full.
  virtual Status begin(bool writes) = 0;
  virtual Status commit() = 0;
  virtual void rollback() = 0;

  // The catalogue. Names are case-sensitive. `objects`, `find` and `is_imported` may stand outside a transaction.
  virtual Result<std::vector<ObjectInfo>> objects() = 0;
  virtual Result<std::optional<ObjectInfo>> find(const std::string& name) = 0;
  /// A new object without a value. Errors: name_exists, type_error for a type that cannot be stored.
  virtual Status create(const std::string& name, const TypeExpr& type) = 0;
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

 protected:
  Store() = default;
};

}  // namespace queries
