#pragma once

#include <cmath>

#include "algebra3d/kernel/exact/detail/exact_coordinates.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/exact/predicates_filter.h"

namespace algebra3d::detail {

/// The interval [centre - radius, centre + radius] around an exact number. Radii are rounded up by a factor, without
/// switching the rounding mode. Radius 0: the number is the centre. Beyond the range of doubles the radius becomes
/// infinite or NaN, and the sign is undecided.
struct Interval {
  double centre = 0;
  double radius = 0;

  bool is_zero() const { return centre == 0 && radius == 0; }
  /// Sign of the number, or kUndecided.
  int sign() const { return centre > radius ? 1 : centre < -radius ? -1 : is_zero() ? 0 : kUndecided; }
};

// The factor 1 + 2^-50 covers up to seven roundings of 2^-53 in a radius. The second term covers underflow, and keeps
// the radii out of the slow subnormal range.
inline Interval widened(double centre, double radius) {
  return {centre, (radius + 0x1p-53 * std::abs(centre)) * (1 + 0x1p-50) + 0x1p-1000};
}

inline Interval operator+(const Interval& a, const Interval& b) {
  const double centre = a.centre + b.centre;
  if (centre == 0 && a.radius == 0 && b.radius == 0) return {};  // a sum of doubles rounds to 0 only if it is 0
  return widened(centre, a.radius + b.radius);
}

inline Interval operator-(const Interval& a, const Interval& b) {
  return a + Interval{-b.centre, b.radius};
}

inline Interval operator*(const Interval& a, const Interval& b) {
  if (a.is_zero() || b.is_zero()) return {};
  const double from_radii = std::abs(a.centre) * b.radius + a.radius * std::abs(b.centre) + a.radius * b.radius;
  return widened(a.centre * b.centre, from_radii);
}

/// Interval of one coordinate of a point; the radius is 0 for a double.
inline Interval interval_of(const PointRef& point, std::size_t axis) {
  const double rounded = point.approx[axis];
  return point.is_double() || point.exact->beyond(axis) == 0 ? Interval{rounded, 0} : widened(rounded, 0);
}

}  // namespace algebra3d::detail
