#pragma once

#include <filesystem>

#include "algebra3d/base/error.h"

namespace queries {

/// Checks SQLite's files beside a database before SQLite sees them, since they may have come with a database of
/// somebody else: each must be a regular file, and a rollback journal must not name another file. SQLite takes that for
/// the journal of several databases and deletes it when it has rolled back, wherever it lies; this program makes no
/// such journals. Errors: database_foreign with the name of the file beside.
algebra3d::Status check_sidecar_files(const std::filesystem::path& database);

}  // namespace queries
