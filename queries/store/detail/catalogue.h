#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "algebra3d/values/types/type_expr.h"
#include "queries/store/detail/sqlite_connection.h"

namespace queries {

/// One object of the database: a row of the table `catalogue`.
struct CatalogueEntry {
  std::int64_t id = 0;  ///< never reused
  std::string name;
  algebra3d::TypeExpr type;
  bool has_value = false;
  std::string function_text;
  // A relation with a value:
  std::int64_t table_number = 0;
  std::int64_t tuple_count = 0;
  std::int64_t next_tuple = 1;  ///< the id of the next tuple
  std::uint64_t tuple_sum = 0;  ///< sum of the checksums of all rows, to detect lost rows
  // An index definition:
  std::string index_relation;
  std::string index_attribute;
  // A value, or a frozen index:
  std::uint64_t value_sum = 0;  ///< checksum of its bytes
  // A derived object:
  std::string derived_text = {};  ///< the expression of its value
};

/// The catalogue of a database, in memory. It is read as a whole, verified by its checksum, and written back before a
/// commit. Used by one thread. Entries keep their addresses until they are removed or `forget` is called.
class Catalogue {
 public:
  explicit Catalogue(SqliteConnection& connection) : connection_(connection) {}

  /// Reads the catalogue, unless it is in memory, from a file of this version or an older one. Call within a
  /// transaction. Errors: database_corrupt, database_version.
  algebra3d::Status load();
  /// Makes `load` accept a damaged catalogue: it reads the intact rows and lists the damage. For read-only use.
  void tolerate_damage() { is_tolerant_ = true; }
  /// The damage that `load` found, if it is tolerated.
  const std::vector<std::string>& damage() const { return damage_; }
  /// Drops the catalogue from memory, after a rollback or when another process has written.
  void forget();
  /// The version of the file.
  std::int64_t version() const { return version_; }
  /// Upgrades the tables of an older file to this version, and writes the catalogue again. Call within a transaction.
  algebra3d::Status upgrade();

  /// Makes the tables of row groups in a file of the version before, which becomes one of this version. Call within a
  /// transaction that writes.
  algebra3d::Status add_row_groups();

  /// The entry of this name, or null.
  const CatalogueEntry* find(const std::string& name) const;
  /// All entries, in the order of names.
  const std::map<std::string, CatalogueEntry>& entries() const { return entries_; }
  /// The named types, in the order of names.
  const std::map<std::string, algebra3d::TypeExpr>& types() const { return types_; }

  /// Whether a damaged catalogue is accepted.
  bool is_tolerant() const { return is_tolerant_; }
  /// The next result of `take_number`.
  std::int64_t next_number() const { return next_number_; }

  // Changes. Each takes effect in the file with `flush`.
  CatalogueEntry& add(CatalogueEntry entry);
  /// The entry of this name, for changing, or null.
  CatalogueEntry* edit(const std::string& name);
  /// Renames the existing object `from` to the unused name `to`.
  CatalogueEntry& rename(const std::string& from, const std::string& to);
  void remove(const std::string& name);
  void set_type(const std::string& name, algebra3d::TypeExpr type);
  void remove_type(const std::string& name);
  /// A new number for an object or a table.
  std::int64_t take_number() { return is_changed_ = true, next_number_++; }
  algebra3d::Status flush();

 private:
  algebra3d::Status upgrade_from_version1();
  algebra3d::Status check_version();
  algebra3d::Status read_all();
  algebra3d::Status read_entries(bool backwards = false);
  algebra3d::Status read_readable();
  void remember_damage(const algebra3d::Error& error);
  algebra3d::Status read_types();
  algebra3d::Status check_sum();
  algebra3d::Status write(const CatalogueEntry& entry);
  algebra3d::Status write_type(const std::string& name);
  algebra3d::Status write_meta();
  std::uint64_t sum() const;

  SqliteConnection& connection_;
  std::int64_t version_ = 0;  // of the file
  std::map<std::string, CatalogueEntry> entries_;
  std::map<std::string, algebra3d::TypeExpr> types_;
  std::set<std::string> edited_;
  std::set<std::int64_t> removed_;
  std::set<std::string> edited_types_;  // created, changed or removed
  std::int64_t next_number_ = 1;
  bool is_loaded_ = false;
  bool is_tolerant_ = false;
  std::vector<std::string> damage_;
  bool is_changed_ = false;
};

}  // namespace queries
