#pragma once

#include <array>

#include "algebra3d/exact/big_integer.h"
#include "algebra3d/exact/predicates.h"

namespace algebra3d::detail {

/// Homogeneous coordinates of a point: x = X / W and so on, all integers, W > 0. Determinants of these need no
/// fractions, and so no search for common divisors, which is what takes the time in arithmetic with rationals.
struct HomogeneousPoint {
  BigInteger x, y, z, w;

  mpz_srcptr operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : axis == 2 ? z : w; }
  mpz_ptr operator[](std::size_t axis) { return axis == 0 ? x : axis == 1 ? y : axis == 2 ? z : w; }
  /// In lowest terms.
  void set(const RationalVec3& point);
  void set(const Vec3& doubles);
};

/// Homogeneous coordinates to read: those that an exact point has, or numbers that are kept elsewhere.
class HomogeneousView {
 public:
  /// Of a point of doubles the integers are made in `room`.
  HomogeneousView(const PointRef& point, HomogeneousPoint& room);
  HomogeneousView(const HomogeneousPoint& numbers)  // NOLINT(google-explicit-constructor)
      : numbers_{numbers.x, numbers.y, numbers.z, numbers.w} {}

  mpz_srcptr operator[](std::size_t i) const { return numbers_[i]; }

 private:
  std::array<mpz_srcptr, 4> numbers_;
};

void divide_by_common_divisor(HomogeneousPoint& numbers);
/// The sum of the four products: of a plane and a point, the value of the plane's equation there times W.
void dot(mpz_ptr result, const HomogeneousView& a, const HomogeneousView& b);

/// The four numbers that are orthogonal to the three given rows: the plane (a, b, c, -d) through three points, with
/// the normal (q - p) x (r - p), or, since both are linear, the point that three planes have in common, up to its sign.
void join(HomogeneousPoint& result, const HomogeneousView& p, const HomogeneousView& q, const HomogeneousView& r);
/// The same for points of doubles, which takes half the products.
void join(HomogeneousPoint& result, const Vec3& p, const Vec3& q, const Vec3& r);

/// Compares a / b with c / d, where b and d are positive.
std::strong_ordering compare_quotients(mpz_srcptr a, mpz_srcptr b, mpz_srcptr c, mpz_srcptr d);

/// Sign of orient3d and orient2d by homogeneous coordinates. Exact for all points. Thread-safe; keeps its numbers from
/// call to call.
int orient3d_by_integers(const std::array<const PointRef*, 4>& points);
int orient2d_by_integers(Projection plane, const std::array<const PointRef*, 3>& points);

}  // namespace algebra3d::detail
