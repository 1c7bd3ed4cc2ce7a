#pragma once

#include <filesystem>
#include <memory>

#include "queries/store/sqlite_connection.h"
#include "queries/store/store_options.h"

namespace queries {

/// In the header of every database of ours: "A3DB".
inline constexpr std::int64_t kApplicationId = 0x41334442;
/// Version of the tables, docs/file_format.md; a newer one is refused.
inline constexpr std::int64_t kDatabaseVersion = 1;

/// A connection to a database of ours, made now if `mode` wants it. Files that are not ours are not touched.
/// Errors: those of Store::open.
Result<std::unique_ptr<SqliteConnection>> open_database_file(const std::filesystem::path& file, OpenMode mode,
                                                             const StoreOptions& options);

}  // namespace queries
