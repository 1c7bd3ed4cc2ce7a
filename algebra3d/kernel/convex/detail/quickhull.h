#pragma once

#include <array>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/halfedge/handle.h"
#include "algebra3d/kernel/exact/point.h"

namespace algebra3d::detail {

/// A triangle of the boundary of a convex hull.
struct HullTriangle {
  std::array<VertexId, 3> corners;   ///< numbers of points, counter-clockwise seen from outside
  std::array<FaceId, 3> neighbours;  ///< across the edge from corner i to the next one
};

/// The boundary of the convex hull of points, triangulated: no triangle is degenerate, and no two overlap. Corners may
/// lie in the middle of facets and edges of the hull.
///
/// Quickhull: every triangle keeps the points in front of it that are not yet decided, each point with one triangle.
/// The farthest point of a triangle replaces all triangles that have it in front by a cone over their horizon. Only
/// points strictly in front count, decided exactly. So no triangle of the cone is degenerate: a point on the line of a
/// horizon edge would lie in the planes of both of its triangles.
///
/// `simplex`: four points that are not coplanar. Errors: interrupted. Cost: n log n for most sets; quadratic at worst.
/// Source: [barber1996].
Result<std::vector<HullTriangle>> quickhull(const PointArray& points, const std::array<VertexId, 4>& simplex,
                                            const Monitor& monitor);

}  // namespace algebra3d::detail
