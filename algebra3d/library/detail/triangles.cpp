#include "algebra3d/library/detail/triangles.h"

#include <algorithm>
#include <utility>

#include "algebra3d/kernel/halfedge/given_arrays.h"
#include "algebra3d/kernel/halfedge/mesh_triangles.h"

namespace algebra3d::detail {

Status check_finite(std::string_view what, const Vec3& numbers) {
  if (is_finite(numbers)) return {};
  return Error{ErrorCode::invalid_value,
               "{}: expected finite numbers, found ({}, {}, {})",
               what,
               numbers.x,
               numbers.y,
               numbers.z};
}

IndexedTriangles rounded_triangles(const TriangleMesh& mesh) {
  return {mesh.points().approx(), triangles_of(mesh)};
}

Result<TriangleMesh> welded_mesh(std::span<const Vec3> points,
                                 std::span<const std::array<std::uint32_t, 3>> triangles) {
  A3D_TRY(check_points(points));
  A3D_TRY(check_triangles(points.size(), triangles));
  WeldedTriangles welded = weld(points, triangles);
  return TriangleMesh(std::move(welded.points), welded.triangles);
}

}  // namespace algebra3d::detail
