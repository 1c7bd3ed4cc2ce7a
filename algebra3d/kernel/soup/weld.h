#pragma once

#include <array>
#include <span>
#include <vector>

#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "base/triangle_soup.h"

namespace algebra3d {

/// Triangles over shared points, the input of TriangleMesh.
struct WeldedTriangles {
  PointArray points;
  std::vector<TriangleMesh::Triangle> triangles;
};

/// Welds equal corners. Points are distinct and numbered by first use; triangles and their corners keep their order.
/// Coordinates must be finite. Exactness: equal means equal doubles; -0.0 equals 0.0 and becomes 0.0. No tolerance.
/// Errors: none; at most TriangleMesh::kMaxFaces triangles (asserted). Cost: linear expected, no recursion.
WeldedTriangles weld(std::span<const TriangleSoup::Triangle> triangles);

/// Welds triangles over a list of points, which may be equal or unused.
WeldedTriangles weld(std::span<const Vec3> points, std::span<const TriangleMesh::Triangle> triangles);

/// Welds corners with exact coordinates: equal means equal as rationals.
WeldedTriangles weld(std::span<const std::array<ExactPoint, 3>> triangles);

}  // namespace algebra3d
