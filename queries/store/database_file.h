#pragma once

#include <filesystem>
#include <memory>

#include "queries/store/sqlite_connection.h"
#include "queries/store/store_options.h"

namespace queries {

/// A connection to a database of ours, made now if `mode` wants it. Files that are not ours are not touched.
/// Errors: those of Store::open.
Result<std::unique_ptr<SqliteConnection>> open_database_file(const std::filesystem::path& file, OpenMode mode,
                                                             const StoreOptions& options);

}  // namespace queries
