#include "algebra3d/kernel/halfedge/given_arrays.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "base/interruption_scope.h"
#include "base/large_allocator.h"

namespace algebra3d {

Status check_points(std::span<const Vec3> points) {
  if (points.size() > PolygonMesh::kMaxHalfedges)
    return Error{ErrorCode::limit_exceeded, "{} points; expected at most {}", points.size(),
                 PolygonMesh::kMaxHalfedges};
  for (std::size_t i = 0; i < points.size(); ++i) {
    poll_interruption_at(i);
    const auto& [x, y, z] = points[i];
    if (!is_finite(points[i]))
      return Error{ErrorCode::invalid_value, "point {}: expected finite coordinates, found ({}, {}, {})", i, x, y, z};
  }
  return {};
}

Status check_corners(std::size_t point_count, std::span<const std::uint32_t> corners) {
  if (corners.size() > PolygonMesh::kMaxHalfedges)
    return Error{ErrorCode::limit_exceeded, "{} corners; expected at most {}", corners.size(),
                 PolygonMesh::kMaxHalfedges};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    poll_interruption_at(i);
    if (corners[i] >= point_count)
      return Error{ErrorCode::invalid_value, "corner {}: there is no point {}; there are {}, numbered from 0", i,
                   corners[i], point_count};
  }
  return {};
}

Status check_triangles(std::size_t point_count, std::span<const std::array<std::uint32_t, 3>> triangles) {
  if (triangles.size() > TriangleMesh::kMaxFaces)
    return Error{ErrorCode::limit_exceeded, "{} triangles; expected at most {}", triangles.size(),
                 TriangleMesh::kMaxFaces};
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    poll_interruption_at(f);
    if (const std::uint32_t largest = std::ranges::max(triangles[f]); largest >= point_count)
      return Error{ErrorCode::invalid_value, "triangle {}: there is no point {}; there are {}, numbered from 0", f,
                   largest, point_count};
  }
  return {};
}

Result<PolygonLayout> layout_of(std::span<const std::uint32_t> degrees, std::size_t corner_count) {
  LargeVector<std::uint32_t> starts{0};
  starts.reserve(degrees.size() + 1);
  std::size_t sum = 0;
  for (std::size_t f = 0; f < degrees.size() && sum <= corner_count; ++f) {
    poll_interruption_at(f);
    if (degrees[f] < 3)
      return Error{ErrorCode::invalid_value, "face {}: expected three or more corners, found {}", f, degrees[f]};
    sum += degrees[f];
    starts.push_back(static_cast<std::uint32_t>(sum));
  }
  if (sum != corner_count)
    return Error{ErrorCode::invalid_value, "{} corners; the faces have {}", corner_count,
                 std::accumulate(degrees.begin(), degrees.end(), std::uint64_t{0})};
  return PolygonLayout(std::move(starts));
}

}  // namespace algebra3d
