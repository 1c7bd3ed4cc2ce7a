#pragma once

#include <cstddef>

#include "base/polygon_soup.h"
#include "base/triangle_soup.h"

namespace mesh_formats {

/// Reserves memory for `count` triangles and normals, in huge pages if it is large. The memory is not touched.
void reserve_triangles(algebra3d::TriangleSoup& soup, std::size_t count);

/// Reserves memory for points, and for faces and their corners, in this way.
void reserve_points(algebra3d::PolygonSoup& soup, std::size_t count);
void reserve_faces(algebra3d::PolygonSoup& soup, std::size_t face_count, std::size_t corner_count);

}  // namespace mesh_formats
