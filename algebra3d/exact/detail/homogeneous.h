#pragma once

#include <array>

#include <gmpxx.h>

#include "algebra3d/exact/predicates.h"

namespace algebra3d::detail {

/// Homogeneous coordinates of a point: x = X / W and so on, all integers, W > 0. Their determinants need no fractions
/// and so no greatest common divisors, which dominate the cost of rational arithmetic.
struct HomogeneousPoint {
  mpz_class x, y, z, w;

  mpz_srcptr operator[](std::size_t axis) const {
    return (axis == 0 ? x : axis == 1 ? y : axis == 2 ? z : w).get_mpz_t();
  }
  mpz_ptr operator[](std::size_t axis) { return (axis == 0 ? x : axis == 1 ? y : axis == 2 ? z : w).get_mpz_t(); }
  /// Sets the coordinates, in lowest terms.
  void set(const RationalVec3& point);
  void set(const Vec3& doubles);
};

/// A read-only view of homogeneous coordinates, of an exact point or of numbers elsewhere.
class HomogeneousView {
 public:
  /// For a point of doubles the integers are computed in `buffer`.
  HomogeneousView(const PointRef& point, HomogeneousPoint& buffer);
  HomogeneousView(const HomogeneousPoint& numbers)  // NOLINT(google-explicit-constructor)
      : numbers_{numbers[0], numbers[1], numbers[2], numbers[3]} {}

  mpz_srcptr operator[](std::size_t i) const { return numbers_[i]; }

 private:
  std::array<mpz_srcptr, 4> numbers_;
};

/// Divide the numbers, not all of which may be zero, by what they have in common, or by powers of two alone.
void divide_by_common_divisor(HomogeneousPoint& numbers);
void divide_by_powers_of_two(HomogeneousPoint& numbers);
/// The scalar product of the four numbers. For a plane and a point: the value of the plane's equation times W.
void dot(mpz_class& result, const HomogeneousView& a, const HomogeneousView& b);

/// The four numbers orthogonal to three rows: the plane (a, b, c, -d) through three points, with the normal (q - p) x
/// (r - p); or, dually, the common point of three planes, up to its sign.
void join(HomogeneousPoint& result, const HomogeneousView& p, const HomogeneousView& q, const HomogeneousView& r);
/// The same for points of doubles, with half the products.
void join(HomogeneousPoint& result, const Vec3& p, const Vec3& q, const Vec3& r);

/// Compares a / b with c / d, where b and d are positive.
std::strong_ordering compare_quotients(mpz_srcptr a, mpz_srcptr b, mpz_srcptr c, mpz_srcptr d);

/// orient3d and orient2d by homogeneous coordinates. Exact for all points. Thread-safe; reuses its numbers between
/// calls.
int orient3d_by_integers(const std::array<const PointRef*, 4>& points);
int orient2d_by_integers(Projection plane, const std::array<const PointRef*, 3>& points);

}  // namespace algebra3d::detail
