#pragma once

#include <filesystem>
#include <string_view>

#include "algebra3d/base/draft_file.h"
#include "queries/store/store_options.h"

namespace queries {

/// Makes an empty database at `file`, where there is nothing or, with `replaces_empty`, an empty file. It appears there
/// when it is complete; if another process is faster, its database stays. The result locks the new file as a draft:
/// whoever fills it under an interim name keeps this until then. Errors: disk_full, io_error, file_missing.
Result<algebra3d::DraftFile> create_database_file(const std::filesystem::path& file, bool replaces_empty,
                                                  const StoreOptions& options);

/// The ending of the name under which a database is restored until it is complete, before a process id.
inline constexpr std::string_view kRestoreMark = ".restore-";

/// Removes what killed processes have left in the folder of `file` when they made or restored databases there, as far
/// as their owners are known to be gone.
void remove_database_leftovers(const std::filesystem::path& file);

/// Removes the database file `name`, which no process has open, with the files beside it. Errors: database_missing,
/// database_foreign, database_open if a process has it open, io_error.
Status delete_database_file(const std::filesystem::path& name);

}  // namespace queries
