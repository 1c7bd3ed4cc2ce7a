#pragma once

#include <cmath>

#include "algebra3d/kernel/exact/counters.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/exact/predicates_filter.h"

namespace algebra3d {

namespace detail {

/// A point of the plane, for the filter.
struct PlaneVec {
  double x, y;
};

// The determinant of [shewchuk1997], section 4.4: ten roundings of 2^-53 bound its error relative to the same sum with
// all signs made positive; the unit more covers the roundings of the bound itself.
inline constexpr double kInCircleError = 11 * 0x1p-53;

/// Sign of the in-circle determinant, or kUndecided. An underflow causes an error of at most 2^-1075, which a minor or
/// a squared length may enlarge; an overflow makes the bound infinite or NaN, so all comparisons are false.
inline int filter_in_circle(PlaneVec a, PlaneVec b, PlaneVec c, PlaneVec d) {
  const double adx = a.x - d.x, ady = a.y - d.y;
  const double bdx = b.x - d.x, bdy = b.y - d.y;
  const double cdx = c.x - d.x, cdy = c.y - d.y;
  const double bc = bdx * cdy, cb = cdx * bdy;
  const double ca = cdx * ady, ac = adx * cdy;
  const double ab = adx * bdy, ba = bdx * ady;
  const double a_square = adx * adx + ady * ady;
  const double b_square = bdx * bdx + bdy * bdy;
  const double c_square = cdx * cdx + cdy * cdy;
  const double determinant = a_square * (bc - cb) + b_square * (ca - ac) + c_square * (ab - ba);
  const double size_bc = std::abs(bc) + std::abs(cb);
  const double size_ca = std::abs(ca) + std::abs(ac);
  const double size_ab = std::abs(ab) + std::abs(ba);
  const double size = a_square * size_bc + b_square * size_ca + c_square * size_ab;
  const double factors = (a_square + b_square + c_square) + (size_bc + size_ca + size_ab);
  const double error = kInCircleError * size + kUnderflowError * (1 + factors);
  if (determinant > error) return 1;
  if (determinant < -error) return -1;
  return kUndecided;
}

// Decides what the filter leaves undecided.
int decide_in_circle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
int in_circle_of_rationals(const PointRef& a, const PointRef& b, const PointRef& c, const PointRef& d);

}  // namespace detail

/// The in-circle test in the projection to the plane z = 0: 1 if d is inside the circle through a, b and c, 0 if on it,
/// -1 if outside, for abc counter-clockwise; the opposite for clockwise. For collinear a, b, c it is the sign of the
/// in-circle determinant, which changes whenever two of the four points are exchanged. Exact for all finite input,
/// subnormal and huge values included. Cost: about ten nanoseconds when the filter decides; some fifty if not and all
/// coordinates are multiples of one power of two within 60 bits; microseconds for other doubles. Rationals are decided
/// by intervals if possible, else by big integers. Source: [shewchuk1997], [bronnimann2001].
inline int in_circle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  detail::count_call();
  const int sign = detail::filter_in_circle({a.x, a.y}, {b.x, b.y}, {c.x, c.y}, {d.x, d.y});
  return sign != detail::kUndecided ? sign : detail::decide_in_circle(a, b, c, d);
}
inline int in_circle(const PointRef& a, const PointRef& b, const PointRef& c, const PointRef& d) {
  if (a.is_double() && b.is_double() && c.is_double() && d.is_double()) [[likely]]
    return in_circle(a.approx, b.approx, c.approx, d.approx);
  detail::count_call();
  return detail::in_circle_of_rationals(a, b, c, d);
}

}  // namespace algebra3d
