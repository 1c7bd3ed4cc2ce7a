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

/// The error of a database that was there when it was to be opened and no longer is.
Error deleted_meanwhile(const std::filesystem::path& file);

/// What the file lacks by its own header, as a sentence; empty: nothing, or this process has it open.
std::string lost_bytes(const std::filesystem::path& file);

/// Error unless the file begins as a database of ours does, of a version that is known.
Status check_database_header(const std::filesystem::path& file);

}  // namespace queries
