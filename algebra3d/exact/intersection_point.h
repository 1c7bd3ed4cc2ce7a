#pragma once

#include <cstddef>

#include "algebra3d/exact/homogeneous.h"
#include "algebra3d/exact/plane.h"
#include "algebra3d/exact/predicates.h"

namespace algebra3d {

/// An oriented plane by four integers without a common divisor: a x + b y + c z = d. Points are computed from these
/// without fractions, whose common divisors would have to be searched after every step.
class IntegerPlane {
 public:
  /// Through the corners of a triangle that is not degenerate, in front where it turns counter-clockwise.
  static IntegerPlane through(const TriangleRef& triangle);
  /// Through two different points, parallel to an axis (0: x, 1: y, 2: z) to which their line is not parallel.
  static IntegerPlane along_axis(PointRef p, PointRef q, std::size_t axis);

  ExactPlane exact() const;
  /// The same plane with the same front: planes have one form.
  friend bool operator==(const IntegerPlane& a, const IntegerPlane& b);

 private:
  friend ExactPoint intersect_line_plane(PointRef a, PointRef b, const IntegerPlane& plane);
  friend ExactPoint intersect_planes(const IntegerPlane& p, const IntegerPlane& q, const IntegerPlane& r);
  void reduce();

  detail::HomogeneousPoint numbers_;  // a, b, c, -d
};

/// The point in which the line through a and b meets the plane. They must not be parallel. Exact, in lowest terms.
ExactPoint intersect_line_plane(PointRef a, PointRef b, const IntegerPlane& plane);

/// The point that three planes have in common. Their normals must be linearly independent. Exact, in lowest terms.
ExactPoint intersect_planes(const IntegerPlane& p, const IntegerPlane& q, const IntegerPlane& r);

}  // namespace algebra3d
