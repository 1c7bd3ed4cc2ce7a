#pragma once

#include <array>
#include <span>
#include <vector>

#include "algebra3d/base/triangle_soup.h"
#include "algebra3d/exact/point.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// Triangles over shared points: what TriangleMesh is made from.
struct WeldedTriangles {
  PointArray points;
  std::vector<TriangleMesh::Triangle> triangles;
};

/// Joins equal corners: the points are numbered in the order in which the triangles first use them, no two of them are
/// equal, and the triangles keep their order and that of their corners. Coordinates are finite.
/// Exactness: equal means equal doubles; -0.0 equals 0.0 and becomes 0.0. No tolerance.
/// Errors: none; at most TriangleMesh::kMaxFaces triangles (asserted). Cost: linear expected, no recursion.
WeldedTriangles weld(std::span<const TriangleSoup::Triangle> triangles);

/// The same for triangles over a list of points, of which some may be equal or not used.
WeldedTriangles weld(std::span<const Vec3> points, std::span<const TriangleMesh::Triangle> triangles);

/// The same for corners with exact coordinates: equal means equal as rationals.
WeldedTriangles weld(std::span<const std::array<ExactPoint, 3>> triangles);

}  // namespace algebra3d
