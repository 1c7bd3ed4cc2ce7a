#pragma once

#include <array>
#include <cstddef>

#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d::distances {

/// A triangle, a segment or a point: the convex hull of one to three different corners, no three of which lie on a
/// line.
struct Simplex {
  TriangleRef corners;
  std::size_t size;  ///< number of corners

  static Simplex of_point(const PointRef& point) { return {{point, point, point}, 1}; }
  /// The points of a face. A face that repeats a corner is a segment or a point.
  static Simplex of_face(const TriangleMesh& mesh, FaceId face) {
    const TriangleRef corners = mesh.corners(face);
    const auto [a, b, c] = mesh.triangle(face);
    if (a == b) return {{corners[0], corners[2], corners[2]}, b == c ? 1U : 2U};
    return {corners, a == c || b == c ? 2U : 3U};
  }
};

/// Some corners of a simplex, one bit each: a vertex, an edge, or the simplex itself.
using Feature = std::uint8_t;

}  // namespace algebra3d::distances
