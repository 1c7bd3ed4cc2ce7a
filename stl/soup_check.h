#pragma once

#include <filesystem>

#include "algebra3d/base/error.h"
#include "algebra3d/base/polygon_soup.h"

namespace stl {

/// What the coordinates of a file are.
enum class CoordinateRange { doubles, floats };

/// Makes sure that `soup` can be written: coordinates are finite and within the range, every face has at least 3
/// corners, and these are indices of points. The message begins with `path`, where it would be written.
/// Errors: invalid_value, naming point or face, what was found and what was expected. Cost: linear.
algebra3d::Status check_soup(const std::filesystem::path& path, const algebra3d::PolygonSoup& soup,
                             CoordinateRange range);

}  // namespace stl
