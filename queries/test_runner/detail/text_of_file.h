#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include "algebra3d/base/error.h"

namespace queries {

/// The bytes of a regular file. Errors: file_missing, io_error, interrupted.
algebra3d::Result<std::string> read_text(const std::filesystem::path& file, const std::atomic<bool>* cancel);

}  // namespace queries
