#pragma once

#include "base/polygon_soup.h"
#include "base/triangle_soup.h"

namespace algebra3d {

/// Triangulates the polygons of a soup, in order, with the orientation of the polygons:
/// - a convex polygon (in projection along its normal) becomes a fan around its first corner;
/// - any other polygon is triangulated in the projection along the axis nearest to its normal, without overlap;
/// - a polygon that crosses itself there becomes the triangles of least total area.
/// A face of three corners becomes its triangle, even if corners repeat. In other faces, repeated adjacent corners
/// count once; a face with fewer than three corners left is dropped. Exactness: coordinates are not changed. Cost: n
/// log n for a polygon of n corners; n^3 for those that cross themselves (loop_triangulation.h).
TriangleSoup triangles_of(const PolygonSoup& polygons);

}  // namespace algebra3d
