#pragma once

#include <cstdint>
#include <vector>

#include "queries/store/detail/sqlite_connection.h"
#include "queries/store/store.h"

namespace queries {

// The table pulled_tables: docs/file_format.md. A file has it from the first pull on.

Result<bool> has_pulled_tables(SqliteConnection& connection);
/// The rows of a relation, by its number. Errors: database_corrupt.
Result<std::vector<Store::PulledTable>> read_pulled_tables(SqliteConnection& connection, std::int64_t relation);
/// Makes the table unless it is there.
Status write_pulled_table(SqliteConnection& connection, std::int64_t relation, const Store::PulledTable& table);
Status erase_pulled_tables(SqliteConnection& connection, std::int64_t relation);

}  // namespace queries
