#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "algebra3d/exact/plane.h"
#include "algebra3d/exact/predicates.h"

namespace algebra3d {

namespace detail {
class ConstantHomogeneous;
}

/// An oriented plane given by four integers: a x + b y + c z = d; the front is where the left side is larger. They may
/// have a common divisor, as long as they are short. Points are computed from them without fractions, and so without
/// greatest common divisors. Cheap to copy; null by default.
class IntegerPlane {
 public:
  IntegerPlane() = default;
  /// The plane through the corners of a triangle that is not degenerate; from the front it turns counter-clockwise.
  /// Cost: some hundred nanoseconds for doubles, microseconds for other points.
  static IntegerPlane through(const TriangleRef& triangle);
  /// The plane through two different points and parallel to an axis (0: x, 1: y, 2: z), which their line must not be.
  static IntegerPlane along_axis(PointRef p, PointRef q, std::size_t axis);

  /// Converts an ExactPlane; same front.
  static IntegerPlane of(const ExactPlane& plane);

  /// Typical heap size of a plane.
  static constexpr std::size_t kTypicalBytes = 256;

  bool is_null() const { return form_ == nullptr; }
  /// The side on which the point lies: 1 in front, 0 in the plane, -1 behind. Exact: orient3d of three points in it.
  /// Cost: some nanoseconds if rounded numbers decide, else four products of integers.
  int side(const PointRef& point) const;
  /// The coefficients a, b, c, -d times one power of two and rounded, for detail::filter_rounded_side.
  const std::array<double, 4>& rounded() const;
  /// The same plane with front and back exchanged.
  IntegerPlane flipped() const;
  ExactPlane exact() const;
  /// a, b, c, -d.
  const detail::ConstantHomogeneous& coefficients() const;

  /// Same plane, same front.
  friend bool operator==(const IntegerPlane& a, const IntegerPlane& b);

 private:
  struct Form;
  static int side_by_integers(const Form& form, const PointRef& point);
  explicit IntegerPlane(std::shared_ptr<const Form> form) : form_(std::move(form)) {}

  std::shared_ptr<const Form> form_;
};

}  // namespace algebra3d
