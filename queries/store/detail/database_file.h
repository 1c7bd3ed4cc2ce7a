#pragma once

#include <filesystem>
#include <memory>

#include "queries/store/detail/sqlite_connection.h"
#include "queries/store/store_options.h"

namespace queries {

/// Opens a connection to an algebra3d database, and creates the file if `mode` says so. Other files are not touched.
/// Errors: those of Store::open.
Result<std::unique_ptr<SqliteConnection>> open_database_file(const std::filesystem::path& file, OpenMode mode,
                                                             const StoreOptions& options);

/// The error for a database that was deleted while it was being opened.
Error deleted_meanwhile(const std::filesystem::path& file);

/// A sentence that says how many bytes the file lacks according to its header; empty if none, or if this process has
/// the file open.
std::string lost_bytes(const std::filesystem::path& file);

/// Error unless the file begins with the header of an algebra3d database of a known version.
Status check_database_header(const std::filesystem::path& file);

}  // namespace queries
