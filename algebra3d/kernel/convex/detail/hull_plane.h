#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/exact/predicates_filter.h"

namespace algebra3d::detail {

/// Bounds of a set of points, for the error bounds of its planes.
struct CoordinateBounds {
  Vec3 extent;          ///< of the rounded points along each axis; no difference of two is larger
  double rounding = 0;  ///< bound of the error of a difference by rounding points; 0 if all points are doubles
  bool are_doubles = true;

  explicit CoordinateBounds(const PointArray& points) : are_doubles(points.exact_count() == 0) {
    const Box3 box = Box3::around(points.approx());
    if (box.is_empty()) return;
    extent = box.max - box.min;
    if (!are_doubles) rounding = 0x1p-51 * std::max(largest(box.min), largest(box.max));
  }
};

/// The plane of a triangle of the hull, as a filter: rounded heights of points of the set, and a bound of their error
/// that holds for all of them. Source of the bounds: predicates_filter.h.
class HullPlane {
 public:
  HullPlane() = default;
  HullPlane(const std::array<Vec3, 3>& corners, const CoordinateBounds& bounds) : base_(corners[0]) {
    const Vec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
    normal_ = cross(u, v);
    error_ = bounds.are_doubles ? error_of_doubles(u, v, bounds.extent) : error_of_rounded(u, v, bounds);
  }

  /// Six times the volume of the tetrahedron of triangle and point, rounded; positive in front of the triangle.
  double height(const Vec3& p) const { return dot(p - base_, normal_); }
  /// The side of a point with that height: 1 in front, -1 behind, or kUndecided.
  int side(double height) const { return height > error_ ? 1 : height < -error_ ? -1 : kUndecided; }

 private:
  static double error_of_doubles(const Vec3& u, const Vec3& v, const Vec3& extent) {
    const Vec3 magnitude{std::abs(u.y * v.z) + std::abs(u.z * v.y), std::abs(u.z * v.x) + std::abs(u.x * v.z),
                         std::abs(u.x * v.y) + std::abs(u.y * v.x)};
    return kOrient3dError * dot(extent, magnitude) + kUnderflowError * (1 + (extent.x + extent.y + extent.z));
  }
  static double error_of_rounded(const Vec3& u, const Vec3& v, const CoordinateBounds& bounds) {
    const double off = bounds.rounding;
    return error_of_rounded_volume(largest(u) + off, largest(v) + off, largest(bounds.extent) + off, off);
  }

  Vec3 base_, normal_;
  double error_ = 0;
};

}  // namespace algebra3d::detail
