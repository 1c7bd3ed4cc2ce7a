#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// The reason why a file cannot be created or written, in plain words, from `errno`: which folder is missing, what is
/// not a folder, what is read-only, how long a name may be.
std::string write_obstacle(const std::filesystem::path& file, int reason);

/// The error `FILE: OBSTACLE`. Codes: disk_full, file_missing (no such folder), io_error.
Error write_error(const std::filesystem::path& file, int reason);

/// Checks that a name is not empty and has no zero byte, where the system would end it. Errors: file_missing.
Status check_file_name(const std::filesystem::path& file);

/// The error `FILE: interrupted` of reading, when the host asks to stop.
Error interrupted_reading(std::string_view file_name);

/// The reason (`errno`) why no file can be created in the folder of `file`; 0 if its permissions allow it.
int folder_obstacle(const std::filesystem::path& file);

/// The file's folder; `.` for a bare name.
std::filesystem::path folder_of(const std::filesystem::path& file);

}  // namespace algebra3d
