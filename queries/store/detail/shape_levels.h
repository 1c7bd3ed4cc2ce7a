#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

#include "queries/store/detail/sqlite_connection.h"

namespace queries {

class Database;

/// The value that levels belong to: an attribute of a tuple of a table, or (owner 0) an object.
struct LevelPlace {
  std::int64_t owner = 0;
  std::int64_t tuple = 0;
  std::int64_t attribute = 0;

  friend auto operator<=>(const LevelPlace&, const LevelPlace&) = default;
};

/// A row of the table shape_levels: docs/file_format.md. A file has this table from its first level on.
struct LevelKey {
  LevelPlace place;
  std::uint64_t value_sum = 0;  ///< checksum of the encoded value
  std::uint64_t number = 0;

  /// The checksum of the level's bytes, with a seed that depends on the value.
  std::int64_t checksum(std::string_view bytes) const;
};

/// SQLite's limit of a row is 10^9 bytes.
inline constexpr std::size_t kMaxLevelBytes = 999'000'000;

algebra3d::Result<bool> has_level_table(SqliteConnection& connection);
/// Calls `visit` with the bytes; false if there are none. Errors: database_corrupt if they are not what was written.
algebra3d::Result<bool> read_level(SqliteConnection& connection, const LevelKey& key,
                                   const std::function<void(std::string_view)>& visit);
/// Makes the table if there is none.
algebra3d::Status write_level(SqliteConnection& connection, const LevelKey& key, std::string_view bytes);

/// Erases the levels of values that the running statement has changed or removed. Damage in the table is left for
/// `check database` to find. Cost: of the levels of the tables that were changed.
algebra3d::Status erase_outdated_levels(Database& database);

}  // namespace queries
