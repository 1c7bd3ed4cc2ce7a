#pragma once

#include <filesystem>
#include <string_view>

#include "queries/store/store_options.h"

namespace queries {

/// Makes an empty database at `file`, where there is nothing or, with `replaces_empty`, an empty file. It appears there
/// when it is complete; if another process is faster, its database stays. Errors: disk_full, io_error, file_missing.
Status create_database_file(const std::filesystem::path& file, bool replaces_empty);

/// Whether `OpenMode::open_or_create` would make a database: there is no file of that name, or an empty one.
bool makes_database(const std::filesystem::path& file);

/// Fails with database_open if any process, this one included, has the database `name` open at the moment. `verb` is
/// for the message: "restore it when that process has closed it".
Status check_not_open_elsewhere(const std::filesystem::path& name, std::string_view verb);

/// Removes the database file `name`, which no process has open, with the files beside it. Errors: database_missing,
/// database_foreign, database_open if a process has it open, io_error.
Status delete_database_file(const std::filesystem::path& name);

}  // namespace queries
