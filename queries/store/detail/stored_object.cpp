#include "queries/store/detail/stored_object.h"

#include "base/propagate.h"
#include "queries/store/detail/chunks.h"

namespace queries {

Result<std::string> read_object_bytes(Database& database, const CatalogueEntry& entry) {
  SqliteConnection& connection = database.connection();
  A3D_ASSIGN(SqliteStatement statement, connection.use("SELECT value FROM object_values WHERE id = ?"));
  statement.bind(1, entry.id);
  A3D_ASSIGN(const bool has_row, statement.step());
  std::string bytes;
  if (has_row) {
    const Cell cell = statement.column(0);
    bytes = cell.bytes;
    if (cell.is(Cell::Kind::integer)) {
      A3D_ASSIGN(bytes, read_chunks(connection, {0, entry.id, 0}, cell.integer));
    }
  }
  if (checksum_of(bytes) == entry.value_sum) return bytes;
  return Error{ErrorCode::database_corrupt, "the stored value is not what was written"}.about(entry.name);
}

Status write_object_bytes(Database& database, CatalogueEntry& entry, std::string_view bytes) {
  SqliteConnection& connection = database.connection();
  A3D_TRY(erase_chunks(connection, 0, entry.id));
  const bool is_long = bytes.size() > database.options().chunk_bytes;
  A3D_ASSIGN(SqliteStatement statement, connection.use("INSERT OR REPLACE INTO object_values VALUES(?, ?)"));
  statement.bind(1, entry.id);
  statement.bind(2, is_long ? Cell::of(static_cast<std::int64_t>(bytes.size())) : Cell::blob(bytes));
  A3D_TRY(statement.run());
  if (is_long) A3D_TRY(write_chunks(connection, {0, entry.id, 0}, bytes, database.options().chunk_bytes));
  entry.value_sum = checksum_of(bytes);
  entry.has_value = true;
  return {};
}

}  // namespace queries
