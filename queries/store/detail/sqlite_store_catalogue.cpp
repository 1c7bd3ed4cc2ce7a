// The parts of the store that remove and rename objects, and the named types.
#include "base/propagate.h"
#include "queries/store/detail/chunks.h"
#include "queries/store/detail/pulled_tables.h"
#include "queries/store/detail/read_scope.h"
#include "queries/store/detail/sqlite_store.h"
#include "queries/store/detail/stored_object.h"

namespace queries {

/// The object and, with a relation, the index definitions on it.
std::vector<std::string> SqliteStore::with_indexes(const CatalogueEntry& entry) const {
  std::vector<std::string> names = {entry.name};
  if (!entry.type.is_relation()) return names;
  for (const auto& [name, other] : database_->catalogue().entries())
    if (other.index_relation == entry.name) names.push_back(name);
  return names;
}

Status SqliteStore::remove(const std::string& name) {
  A3D_ASSIGN(const CatalogueEntry* entry, required(name));
  return database_->change([&]() -> Status {
    for (const std::string& each : with_indexes(*entry)) A3D_TRY(remove_entry(*database_->catalogue().find(each)));
    return {};
  });
}

Status SqliteStore::remove_entry(const CatalogueEntry& entry) {
  SqliteConnection& connection = database_->connection();
  A3D_TRY(drop_table(entry));
  A3D_TRY(drop_stored_index(entry));
  A3D_TRY(erase_chunks(connection, 0, entry.id));
  for (const char* sql : {"DELETE FROM object_values WHERE id = ?", "DELETE FROM imported_files WHERE relation = ?"}) {
    A3D_ASSIGN(SqliteStatement statement, connection.use(sql));
    A3D_TRY(statement.bind(1, entry.id).run());
  }
  A3D_TRY(erase_pulled_tables(connection, entry.id));
  database_->catalogue().remove(std::string(entry.name));
  return {};
}

// Freeing the pages of a damaged table or value could free those of others.
Status SqliteStore::kill(const std::string& name) {
  A3D_ASSIGN(const CatalogueEntry* entry, required(name));
  return database_->change([&]() -> Status {
    for (const std::string& each : with_indexes(*entry)) {
      const CatalogueEntry& doomed = *database_->catalogue().find(each);
      A3D_ASSIGN(const bool sound, is_sound(doomed));
      A3D_TRY(sound ? remove_entry(doomed) : abandon(doomed));
    }
    return {};
  });
}

Result<bool> SqliteStore::is_sound(const CatalogueEntry& entry) {
  if (!entry.has_value || entry.type.is_function() || !entry.index_relation.empty()) return true;
  const auto unless_damaged = [](const Error& error) -> Result<bool> {
    if (error.code == ErrorCode::database_corrupt) return false;
    return error;
  };
  if (!entry.type.is_relation()) {
    const auto bytes = read_object_bytes(*database_, entry);
    return bytes ? Result<bool>(true) : unless_damaged(bytes.error());
  }
  const auto layout = database_->layout_of(entry);
  if (!layout) return false;
  std::vector<std::string> tables = {(*layout)->table(), "chunks"};
  if ((*layout)->has_columns() && database_->has_row_groups()) {
    tables.insert(tables.end(), {"row_groups", "column_chunks"});
    const auto keys = database_->key_attributes(**layout);
    if (!keys) return unless_damaged(keys.error());
    for (const std::size_t attribute : **keys) tables.push_back((*layout)->keys_table(attribute));
  }
  for (const std::string& table : tables) {
    auto statement = database_->connection().use(fmt::format("PRAGMA quick_check({})", table));
    if (!statement) return unless_damaged(statement.error());
    const auto has_row = statement->step();
    if (!has_row) return unless_damaged(has_row.error());
    if (!*has_row || statement->column(0).bytes != "ok") return false;
  }
  return true;
}

Status SqliteStore::abandon(const CatalogueEntry& entry) {
  const std::int64_t number = entry.type.is_relation() ? entry.table_number : entry.id;
  A3D_ASSIGN(SqliteStatement statement, database_->connection().use("INSERT INTO abandoned VALUES(?, ?)"));
  A3D_TRY(statement.bind(1, number).bind(2, std::string_view(entry.name)).run());
  database_->catalogue().remove(std::string(entry.name));
  return {};
}

Status SqliteStore::rename(const std::string& from, const std::string& to) {
  A3D_ASSIGN(const CatalogueEntry* old, required(from));
  A3D_TRY(check_free(to));
  return database_->change([&]() -> Status {
    std::vector<std::string> names = with_indexes(*old);
    std::shared_ptr<const RelationLayout> before;
    const bool has_table = old->type.is_relation() && old->table_number != 0;
    if (has_table) {
      A3D_ASSIGN(before, database_->layout_of(*old));
      database_->note_renamed(old->table_number);
    }
    const CatalogueEntry& renamed = database_->catalogue().rename(from, to);
    for (std::size_t i = 1; i < names.size(); ++i) database_->catalogue().edit(names[i])->index_relation = to;
    if (!has_table) return {};
    A3D_ASSIGN(const auto after, database_->layout_of(renamed));
    const std::string sql = before->rename_sql(*after);
    return sql.empty() ? Status() : database_->connection().execute(sql);
  });
}

Result<std::vector<NamedType>> SqliteStore::types() {
  const ReadScope scope(*database_);
  A3D_TRY(scope.status());
  std::vector<NamedType> result;
  for (const auto& [name, type] : database_->catalogue().types()) result.push_back({name, type});
  return result;
}

Result<std::optional<TypeExpr>> SqliteStore::find_type(const std::string& name) {
  const ReadScope scope(*database_);
  A3D_TRY(scope.status());
  const auto& types = database_->catalogue().types();
  const auto found = types.find(name);
  return found != types.end() ? std::optional(found->second) : std::nullopt;
}

Status SqliteStore::create_type(const std::string& name, const TypeExpr& type) {
  A3D_TRY(database_->check_reading());
  if (database_->catalogue().types().contains(name))
    return Error{ErrorCode::name_exists, "there is a type '{}' already", name};
  return database_->change([&]() -> Status {
    database_->catalogue().set_type(name, type);
    return {};
  });
}

Status SqliteStore::remove_type(const std::string& name) {
  A3D_TRY(database_->check_reading());
  if (!database_->catalogue().types().contains(name))
    return Error{ErrorCode::unknown_name, "there is no type '{}'", name};
  return database_->change([&]() -> Status {
    database_->catalogue().remove_type(name);
    return {};
  });
}

}  // namespace queries
