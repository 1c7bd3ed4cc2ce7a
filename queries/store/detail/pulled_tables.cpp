#include "queries/store/detail/pulled_tables.h"

#include "base/propagate.h"
#include "queries/store/detail/tables.h"

namespace queries {

Result<bool> has_pulled_tables(SqliteConnection& connection) {
  A3D_ASSIGN(SqliteStatement statement,
             connection.use("SELECT 1 FROM sqlite_schema WHERE type = 'table' AND name = 'pulled_tables'"));
  return statement.step();
}

Result<std::vector<Store::PulledTable>> read_pulled_tables(SqliteConnection& connection, std::int64_t relation) {
  std::vector<Store::PulledTable> tables;
  A3D_ASSIGN(const bool has_table, has_pulled_tables(connection));
  if (!has_table) return tables;
  A3D_ASSIGN(SqliteStatement rows, connection.use("SELECT source, place, count, checksum FROM pulled_tables WHERE "
                                                  "relation = ? ORDER BY source"));
  rows.bind(1, relation);
  while (true) {
    A3D_ASSIGN(const bool has_row, rows.step());
    if (!has_row) return tables;
    tables.push_back({std::string(rows.column(0).bytes), std::string(rows.column(1).bytes),
                      as_unsigned(rows.column(2).integer), as_unsigned(rows.column(3).integer)});
  }
}

Status write_pulled_table(SqliteConnection& connection, std::int64_t relation, const Store::PulledTable& table) {
  A3D_TRY(connection.execute(kCreatePulledTables));
  A3D_ASSIGN(SqliteStatement statement, connection.use("INSERT OR REPLACE INTO pulled_tables VALUES(?, ?, ?, ?, ?)"));
  statement.bind(1, relation).bind(2, table.source).bind(3, table.place).bind(4, as_signed(table.count));
  return statement.bind(5, as_signed(table.checksum)).run();
}

Status erase_pulled_tables(SqliteConnection& connection, std::int64_t relation) {
  A3D_ASSIGN(const bool has_table, has_pulled_tables(connection));
  if (!has_table) return {};
  A3D_ASSIGN(SqliteStatement statement, connection.use("DELETE FROM pulled_tables WHERE relation = ?"));
  return statement.bind(1, relation).run();
}

}  // namespace queries
