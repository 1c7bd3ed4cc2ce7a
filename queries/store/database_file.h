#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "algebra3d/base/draft_file.h"
#include "queries/store/sqlite_connection.h"
#include "queries/store/store_options.h"

namespace queries {

/// A connection to a database and, if the file was made for it, the lock that says that its maker lives.
struct OpenedFile {
  std::optional<algebra3d::DraftFile> draft;  // outlives the connection
  std::unique_ptr<SqliteConnection> connection;
};

/// A connection to a database of ours, made now if `mode` wants it. Files that are not ours are not touched.
/// Errors: those of Store::open.
Result<OpenedFile> open_database_file(const std::filesystem::path& file, OpenMode mode, const StoreOptions& options);

/// The error of a damaged file, with the number of bytes that it lacks by its own header, if it lacks any.
Error with_lost_bytes(const std::filesystem::path& file, Error error);

/// Error unless the file begins as a database of ours does, of a version that is known.
Status check_database_header(const std::filesystem::path& file);

}  // namespace queries
