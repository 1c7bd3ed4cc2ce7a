#pragma once

#include <vector>

#include "algebra3d/kernel/convex/detail/quickhull.h"
#include "base/indices.h"

namespace algebra3d::detail {

/// The boundary of a convex hull, triangulated without more corners than it needs.
struct HullBoundary {
  std::vector<VertexId> extreme_points;  ///< numbers of points, in lexicographic order of these
  std::vector<IndexTriangle> triangles;  ///< over `extreme_points`; each begins with its lowest corner; ascending
};

/// Joins coplanar triangles to facets, drops corners that are not extreme, and divides each facet from its
/// lexicographically lowest corner. So the result depends on the set of points only. Exact. Cost: n log n.
HullBoundary hull_boundary(const PointArray& points, const std::vector<HullTriangle>& triangles);

}  // namespace algebra3d::detail
