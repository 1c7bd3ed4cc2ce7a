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
  void set(const PointRef& point);
};

/// The four numbers that are orthogonal to the three given rows: the plane (a, b, c, -d) through three points, with
/// the normal (q - p) x (r - p), or, since both are linear, the point that three planes have in common, up to its sign.
void join(HomogeneousPoint& result, const HomogeneousPoint& p, const HomogeneousPoint& q, const HomogeneousPoint& r);

/// Sign of orient3d and orient2d by homogeneous coordinates. Exact for all points. Thread-safe; keeps its numbers from
/// call to call.
int orient3d_by_integers(const std::array<const PointRef*, 4>& points);
int orient2d_by_integers(Projection plane, const std::array<const PointRef*, 3>& points);

}  // namespace algebra3d::detail
