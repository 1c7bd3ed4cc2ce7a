#pragma once

#include <cstddef>

#include "algebra3d/base/triangle_soup.h"

namespace stl {

/// Reserves room for `count` triangles and normals, and asks the system to back large rooms with huge pages.
/// Cost: the memory is not touched.
void reserve_room(algebra3d::TriangleSoup& soup, std::size_t count);

}  // namespace stl
