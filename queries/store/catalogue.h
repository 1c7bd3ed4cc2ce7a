#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "algebra3d/types/type_expr.h"
#include "queries/store/sqlite_connection.h"

namespace queries {

/// One object of the database: a row of the table `catalogue`.
struct CatalogueEntry {
  std::int64_t id = 0;  ///< never used again for another object
  std::string name;
  algebra3d::TypeExpr type;
  bool has_value = false;
  std::string function_text;
  // A relation with a value:
  std::int64_t table_number = 0;
  std::int64_t tuple_count = 0;
  std::int64_t next_tuple = 1;  ///< the id of the next tuple
  std::uint64_t tuple_sum = 0;  ///< sum of the checksums of all rows: tells whether rows were lost
  // An index definition:
  std::string index_relation;
  std::string index_attribute;
  // A value, or a frozen index:
  std::uint64_t value_sum = 0;  ///< checksum of its bytes
  // A derived object:
  std::string derived_text = {};  ///< the expression that it comes from
};

/// The catalogue in memory, read as a whole and proved complete by its checksum, written back before a commit.
/// Used by one thread. Entries keep their addresses until they are removed or the catalogue is forgotten.
class Catalogue {
 public:
  explicit Catalogue(SqliteConnection& connection) : connection_(connection) {}

  /// Reads it unless it is at hand, from a file of this version or an older one. Call within a transaction.
  /// Errors: database_corrupt, database_version.
  algebra3d::Status load();
  /// From now on damage keeps nothing from being read: `load` takes the rows that are whole and remembers the rest. For
  /// looking only.
  void tolerate_damage() { is_tolerant_ = true; }
  /// What `load` found damaged, once damage is tolerated.
  const std::vector<std::string>& damage() const { return damage_; }
  /// Forgets everything: after a rollback, or when another process has written.
  void forget();
  bool is_loaded() const { return is_loaded_; }
  /// Makes the tables of an older file those of this version, within a transaction. What was read is written again.
  algebra3d::Status upgrade();

  /// Null if there is none.
  const CatalogueEntry* find(const std::string& name) const;
  /// In the order of names.
  const std::map<std::string, CatalogueEntry>& entries() const { return entries_; }
  /// The named types, in the order of names.
  const std::map<std::string, algebra3d::TypeExpr>& types() const { return types_; }

  /// Whether it keeps what can be read of a damaged one.
  bool is_tolerant() const { return is_tolerant_; }
  /// What `take_number` gives next.
  std::int64_t next_number() const { return next_number_; }

  // Changes. Each takes effect in the file with `flush`.
  CatalogueEntry& add(CatalogueEntry entry);
  /// For changing; null if there is none.
  CatalogueEntry* edit(const std::string& name);
  /// Gives the object `from`, which is there, the name `to`, which is free.
  CatalogueEntry& rename(const std::string& from, const std::string& to);
  void remove(const std::string& name);
  void set_type(const std::string& name, algebra3d::TypeExpr type);
  void remove_type(const std::string& name);
  /// A number for an object or a table, never given before.
  std::int64_t take_number() { return is_changed_ = true, next_number_++; }
  algebra3d::Status flush();

 private:
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
  std::set<std::string> edited_types_;  // made, changed or removed
  std::int64_t next_number_ = 1;
  bool is_loaded_ = false;
  bool is_tolerant_ = false;
  std::vector<std::string> damage_;
  bool is_changed_ = false;
};

}  // namespace queries
