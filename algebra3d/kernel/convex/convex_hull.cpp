#include "algebra3d/kernel/convex/convex_hull.h"

#include <utility>

#include "algebra3d/kernel/convex/detail/first_simplex.h"
#include "algebra3d/kernel/convex/detail/hull_facets.h"
#include "algebra3d/kernel/convex/detail/quickhull.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

Undefined flat(int dimension) {
  switch (dimension) {
    case 0:
      return Undefined{"there is only one point, so the hull is not a solid"};
    case 1:
      return Undefined{"all points lie on one line, so the hull is not a solid"};
    default:
      return Undefined{"all points lie in one plane, so the hull is not a solid"};
  }
}

TriangleMesh mesh_of(const PointArray& points, const detail::HullBoundary& boundary) {
  PointArray vertices;
  vertices.reserve(boundary.extreme_points.size());
  for (const VertexId point : boundary.extreme_points) vertices.push_back(points[point.index()]);
  return {std::move(vertices), boundary.triangles};
}

}  // namespace

Result<Maybe<TriangleMesh>> convex_hull(const PointArray& points, const Monitor& monitor) {
  const detail::FirstSimplex simplex = detail::first_simplex(points);
  if (simplex.dimension < 0) return Maybe<TriangleMesh>(TriangleMesh());
  if (simplex.dimension < 3) return Maybe<TriangleMesh>(flat(simplex.dimension));
  A3D_ASSIGN(const auto triangles, detail::quickhull(points, simplex.corners, monitor));
  return Maybe<TriangleMesh>(mesh_of(points, detail::hull_boundary(points, triangles)));
}

PointArray used_points(const TriangleMesh& mesh) {
  PointArray points;
  points.reserve(mesh.vertex_count());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    if (!mesh.is_isolated(VertexId(v))) points.push_back(mesh.point(VertexId(v)));
  return points;
}

}  // namespace algebra3d
