#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/exact/rational.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

/// Distances of the points of a mesh from another one, by brute force.
namespace algebra3d::solids {

using Wide = std::array<long double, 3>;

inline Wide wide(const Vec3& v) {
  return {v.x, v.y, v.z};
}
inline Wide operator-(const Wide& a, const Wide& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Wide operator*(long double s, const Wide& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
inline Wide operator+(const Wide& a, const Wide& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline long double dot(const Wide& a, const Wide& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Wide cross(const Wide& a, const Wide& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline long double distance_to_segment(const Wide& p, const Wide& a, const Wide& b) {
  const long double share = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0L, 1.0L);
  const Wide difference = (p - a) - share * (b - a);
  return std::sqrt(dot(difference, difference));
}

inline long double distance_to_triangle(const Wide& p, const std::array<Wide, 3>& t) {
  const auto& [a, b, c] = t;
  const Wide normal = cross(b - a, c - a);
  const auto is_left = [&](const Wide& from, const Wide& to) { return dot(cross(to - from, p - from), normal) >= 0; };
  // The normal of a needle may be wrong, so the edges count in any case.
  const bool is_over = is_left(a, b) && is_left(b, c) && is_left(c, a);
  return std::min({is_over ? std::abs(dot(normal, p - a)) / std::sqrt(dot(normal, normal)) : Box3::kInfinity,
                   distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

inline std::array<Wide, 3> wide_corners(const TriangleMesh& mesh, std::size_t face) {
  const TriangleRef corners = mesh.corners(FaceId(face));
  return {wide(corners[0].approx), wide(corners[1].approx), wide(corners[2].approx)};
}

/// The distance of a point to the nearest plane of a triangle over which it is, `at_most` if none is nearer; exact but
/// for the last step.
inline double distance_to_inner_parts(const Vec3& point, const TriangleMesh& mesh, double at_most) {
  const RationalVec3 p(point);
  Rational nearest = Rational(at_most) * Rational(at_most);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleRef corners = mesh.corners(FaceId(f));
    Box3 box;
    for (const PointRef& corner : corners) box.extend(corner.approx);
    const auto is_far = [&](std::size_t axis) {
      return point[axis] < box.min[axis] - 2 * at_most || point[axis] > box.max[axis] + 2 * at_most;
    };
    if (is_far(0) || is_far(1) || is_far(2)) continue;
    const RationalVec3 a = corners[0].rational(), b = corners[1].rational(), c = corners[2].rational();
    const RationalVec3 normal = cross(b - a, c - a);
    const auto is_left = [&](const RationalVec3& from, const RationalVec3& to) {
      return dot(cross(to - from, p - from), normal).sign() >= 0;
    };
    if (!is_left(a, b) || !is_left(b, c) || !is_left(c, a)) continue;
    const Rational along = dot(normal, p - a);
    nearest = std::min(nearest, along * along / dot(normal, normal));
  }
  return std::sqrt(nearest.nearest_double());
}

/// Brute force, at corners and inner points of the rounded triangles, with eleven bits more than doubles have: slivers
/// need them, and needles, whose normals even these do not tell, need rationals. What is left is the rounding of the
/// given corners that are not doubles.
inline void expect_near(const TriangleMesh& rounded, const TriangleMesh& given, double distance) {
  for (std::size_t f = 0; f < rounded.face_count(); ++f) {
    const std::array<Wide, 3> t = wide_corners(rounded, f);
    for (const Wide& weights : {Wide{1, 0, 0}, Wide{0.5L, 0.5L, 0}, Wide{0.3L, 0.3L, 0.4L}, Wide{0.1L, 0.8L, 0.1L}}) {
      const Wide point = weights[0] * t[0] + weights[1] * t[1] + weights[2] * t[2];
      long double nearest = Box3::kInfinity;
      for (std::size_t g = 0; g < given.face_count(); ++g)
        nearest = std::min(nearest, distance_to_triangle(point, wide_corners(given, g)));
      const long double size = 1 + std::abs(point[0]) + std::abs(point[1]) + std::abs(point[2]);
      const Vec3 p{static_cast<double>(point[0]), static_cast<double>(point[1]), static_cast<double>(point[2])};
      if (nearest > distance + 1e-15L * size) nearest = distance_to_inner_parts(p, given, static_cast<double>(nearest));
      ASSERT_LE(nearest, distance + 1e-15L * size);
    }
  }
}

}  // namespace algebra3d::solids
