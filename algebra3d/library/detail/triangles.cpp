#include "algebra3d/library/detail/triangles.h"

#include <algorithm>
#include <utility>

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
  constexpr std::size_t kMaxPoints = 3 * TriangleMesh::kMaxFaces;
  if (points.size() > kMaxPoints)
    return Error{ErrorCode::limit_exceeded, "{} points; expected at most {}", points.size(), kMaxPoints};
  if (triangles.size() > TriangleMesh::kMaxFaces)
    return Error{ErrorCode::limit_exceeded, "{} triangles; expected at most {}", triangles.size(),
                 TriangleMesh::kMaxFaces};
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!is_finite(points[i]))
      return Error{ErrorCode::invalid_value,
                   "point {}: expected finite coordinates, found ({}, {}, {})",
                   i,
                   points[i].x,
                   points[i].y,
                   points[i].z};
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (const std::uint32_t largest = std::ranges::max(triangles[i]); largest >= points.size())
      return Error{ErrorCode::invalid_value, "triangle {}: there is no point {}; there are {}, numbered from 0", i,
                   largest, points.size()};
  WeldedTriangles welded = weld(points, triangles);
  return TriangleMesh(std::move(welded.points), welded.triangles);
}

}  // namespace algebra3d::detail
