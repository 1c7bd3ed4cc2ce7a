#pragma once

#include "algebra3d/base/polygon_soup.h"
#include "algebra3d/base/triangle_soup.h"

namespace algebra3d {

/// The faces of the soup as triangles, in their order, each with the corners and the direction of its polygon:
/// - of a polygon that is convex, as far as its normal can tell, all triangles have its first corner;
/// - any other one is triangulated along the axis that is nearest to its normal, so that its triangles do not overlap;
/// - one that crosses itself as seen that way gets the triangles of least area.
/// A face of three corners is its triangle, even if corners repeat. Of others, corners that repeat in a row count once;
/// what has fewer than three then is left out. Exactness: coordinates are not changed. Cost: n log n for a polygon of n
/// corners; n^3 for those that cross themselves (see triangulate_loop).
TriangleSoup triangles_of(const PolygonSoup& polygons);

}  // namespace algebra3d
