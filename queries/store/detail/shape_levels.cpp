#include "queries/store/detail/shape_levels.h"

#include <algorithm>
#include <array>
#include <set>

#include "base/propagate.h"
#include "queries/store/detail/database.h"
#include "queries/store/detail/tables.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Status;

constexpr std::string_view kObjectIsGone =
    "NOT EXISTS (SELECT 1 FROM catalogue WHERE id = shape_levels.tuple AND value_sum = shape_levels.value_sum)";

void bind(SqliteStatement& statement, const LevelKey& key) {
  statement.bind(1, key.place.owner).bind(2, key.place.tuple).bind(3, key.place.attribute);
  statement.bind(4, as_signed(key.number)).bind(5, as_signed(key.value_sum));
}

Status erase_levels(SqliteConnection& connection, std::int64_t owner, std::string_view condition) {
  A3D_ASSIGN(SqliteStatement statement,
             connection.use(fmt::format("DELETE FROM shape_levels WHERE owner = ? AND {}", condition)));
  return statement.bind(1, owner).run();
}

/// True for levels of an attribute whose value is not in the row any more.
std::string value_is_gone(const RelationLayout& layout, std::size_t attribute) {
  return fmt::format(
      "attribute = {} AND NOT EXISTS (SELECT 1 FROM {} WHERE id = shape_levels.tuple AND {} = shape_levels.value_sum)",
      attribute, layout.table(), layout.column(layout.attributes()[attribute].box + kSumAfterBox));
}

Result<bool> has_levels(SqliteConnection& connection, std::int64_t owner) {
  A3D_ASSIGN(SqliteStatement statement, connection.use("SELECT 1 FROM shape_levels WHERE owner = ? LIMIT 1"));
  return statement.bind(1, owner).step();
}

Status erase_outdated(Database& database, std::int64_t table_number) {
  SqliteConnection& connection = database.connection();
  A3D_ASSIGN(const bool is_concerned, has_levels(connection, table_number));
  if (!is_concerned) return {};
  const auto& entries = database.catalogue().entries();
  const auto entry =
      std::ranges::find_if(entries, [&](const auto& each) { return each.second.table_number == table_number; });
  if (entry == entries.end()) return erase_levels(connection, table_number, "TRUE");
  A3D_ASSIGN(const auto layout, database.layout_of(entry->second));
  for (std::size_t i = 0; i < layout->attributes().size(); ++i)
    if (layout->attributes()[i].form == AttributeForm::large)
      A3D_TRY(erase_levels(connection, table_number, value_is_gone(*layout, i)));
  return {};
}

}  // namespace

std::int64_t LevelKey::checksum(std::string_view bytes) const {
  return as_signed(checksum_of(bytes, value_sum ^ number));
}

Result<bool> has_level_table(SqliteConnection& connection) {
  A3D_ASSIGN(SqliteStatement statement,
             connection.use("SELECT 1 FROM sqlite_schema WHERE type = 'table' AND name = 'shape_levels'"));
  return statement.step();
}

Result<bool> read_level(SqliteConnection& connection, const LevelKey& key,
                        const std::function<void(std::string_view)>& visit) {
  A3D_ASSIGN(const bool has_table, has_level_table(connection));
  if (!has_table) return false;
  A3D_ASSIGN(
      SqliteStatement statement,
      connection.use("SELECT checksum, bytes FROM shape_levels WHERE owner = ? AND tuple = ? AND attribute = ? AND "
                     "number = ? AND value_sum = ?"));
  bind(statement, key);
  A3D_ASSIGN(const bool has_row, statement.step());
  if (!has_row) return false;
  const Cell checksum = statement.column(0), bytes = statement.column(1);
  if (!checksum.is(Cell::Kind::integer) || !bytes.is(Cell::Kind::blob) || checksum.integer != key.checksum(bytes.bytes))
    return Error{ErrorCode::database_corrupt, "a level of detail, or a block of faces, is not what was written"}.about(
        connection.file());
  visit(bytes.bytes);
  return true;
}

Status write_level(SqliteConnection& connection, const LevelKey& key, std::string_view bytes) {
  A3D_ASSIGN(const bool has_table, has_level_table(connection));
  if (!has_table) A3D_TRY(connection.execute(kCreateShapeLevels));
  A3D_ASSIGN(SqliteStatement statement,
             connection.use("INSERT OR REPLACE INTO shape_levels VALUES(?, ?, ?, ?, ?, ?, ?)"));
  bind(statement, key);
  return statement.bind(6, key.checksum(bytes)).bind(7, Cell::blob(bytes)).run();
}

Status erase_outdated_levels(Database& database) {
  SqliteConnection& connection = database.connection();
  A3D_ASSIGN(const bool has_table, has_level_table(connection));
  if (!has_table) return {};
  Status status = erase_levels(connection, 0, kObjectIsGone);
  for (const std::int64_t table : database.changes().tables())
    if (status) status = erase_outdated(database, table);
  // Unless SQLite has undone everything.
  return connection.in_transaction() ? Status() : status;
}

}  // namespace queries
