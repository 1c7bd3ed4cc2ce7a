#pragma once

#include <filesystem>

#include "algebra3d/base/error.h"

namespace queries {

/// Gives a complete database its name, which must be free. Errors: database_exists, io_error.
algebra3d::Status put_in_place(const std::filesystem::path& made, const std::filesystem::path& file);

}  // namespace queries
