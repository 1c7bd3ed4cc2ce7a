#pragma once

#include "algebra3d/base/error.h"
#include "base/mesh_content.h"
#include "base/polygon_soup.h"

namespace mesh_formats {

/// Checks that `soup` can be written: coordinates are finite and in range, every face has at least 3 corners, and
/// indices are valid. Errors: invalid_value, with point or face, what was found and what was expected. Cost: linear.
algebra3d::Status check_soup(const algebra3d::PolygonSoup& soup, CoordinateRange range);

}  // namespace mesh_formats
