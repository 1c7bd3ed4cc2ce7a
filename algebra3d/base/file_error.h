#pragma once

#include <filesystem>
#include <string>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// Why a file cannot be made or written, in plain words, from the system's reason (`errno`): which folder is missing,
/// what is a file and no folder, what is read-only, how long a name may be.
std::string write_obstacle(const std::filesystem::path& file, int reason);

/// `FILE: ` and the obstacle. Codes: disk_full, file_missing (no such folder), io_error.
Error write_error(const std::filesystem::path& file, int reason);

/// The reason for which the folder of `file` takes no new file; 0: it does, as far as permissions tell.
int folder_obstacle(const std::filesystem::path& file);

/// The file's folder; `.` for a bare name.
std::filesystem::path folder_of(const std::filesystem::path& file);

}  // namespace algebra3d
