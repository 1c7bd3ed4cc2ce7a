#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "algebra3d/exact/plane.h"
#include "algebra3d/exact/predicates.h"

namespace algebra3d {

namespace detail {
struct HomogeneousPoint;
}

/// An oriented plane by four integers without a common divisor: a x + b y + c z = d, in front where the left side is
/// the larger one. Points are computed from these without fractions, whose common divisors would have to be searched
/// after every step. Cheap to copy; null by default.
class IntegerPlane {
 public:
  IntegerPlane() = default;
  /// Through the corners of a triangle that is not degenerate, in front where it turns counter-clockwise.
  /// Cost: some hundred nanoseconds for doubles, microseconds for other points.
  static IntegerPlane through(const TriangleRef& triangle);
  /// Through two different points, parallel to an axis (0: x, 1: y, 2: z) to which their line is not parallel.
  static IntegerPlane along_axis(PointRef p, PointRef q, std::size_t axis);

  /// The same plane with the same front.
  static IntegerPlane of(const ExactPlane& plane);

  /// On the heap, of a plane whose numbers are not long.
  static constexpr std::size_t kTypicalBytes = 256;

  bool is_null() const { return form_ == nullptr; }
  /// On which side the point lies: 1 in front, 0 in the plane, -1 behind. Exact: orient3d of three points in it. Cost:
  /// some nanoseconds if rounded numbers tell, else four products of integers.
  int side(const PointRef& point) const;
  /// The same of three points.
  std::array<int, 3> sides(const TriangleRef& points) const;
  /// The same plane with the other front.
  IntegerPlane flipped() const;
  ExactPlane exact() const;
  /// a, b, c, -d.
  const detail::HomogeneousPoint& numbers() const;

  /// The same plane with the same front: planes have one form.
  friend bool operator==(const IntegerPlane& a, const IntegerPlane& b);

 private:
  struct Form;
  static int side_by_integers(const Form& form, const PointRef& point);
  explicit IntegerPlane(std::shared_ptr<const Form> form) : form_(std::move(form)) {}

  std::shared_ptr<const Form> form_;
};

}  // namespace algebra3d
