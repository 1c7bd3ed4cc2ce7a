#include "algebra3d/kernel/convex/detail/ball_filter.h"

#include <cmath>

#include "algebra3d/kernel/exact/expansion.h"
#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/exact/predicates_filter.h"

namespace algebra3d::detail {
namespace {

Vec3 nearest(const RationalVec3& v) {
  return {v.x.nearest_double(), v.y.nearest_double(), v.z.nearest_double()};
}

}  // namespace

CentreDistances::CentreDistances(const RationalVec3& centre) : centre_(centre), high_(nearest(centre)) {
  low_ = nearest(centre - RationalVec3(high_));
}

// A difference has an error of at most three roundings of itself, and of one of the coordinates if these are rounded;
// its square, of twice that. Underflow loses less than 2^-1000.
CentreDistances::Estimate CentreDistances::rough(const PointRef& p) const {
  const Vec3 d = (p.approx - high_) - low_;
  const double square = dot(d, d);
  const double rounding = 0x1p-104 * largest(high_) + (p.is_double() ? 0 : 0x1p-52 * largest(p.approx));
  const double length = std::sqrt(square) + rounding;
  return {square, 0, 0x1p-49 * square + 8 * rounding * length + kUnderflowError};
}

// Computes in pairs of doubles: a rounding is at most 2^-104 of the result.
CentreDistances::Estimate CentreDistances::fine(const PointRef& p) const {
  if (!p.is_double()) return rough(p);
  double value = 0, rest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Rounded first = two_sum(p.approx[axis], -high_[axis]);
    const Rounded difference = two_sum(first.value, first.rest - low_[axis]);
    const Rounded square = two_product(difference.value, difference.value, split(difference.value));
    const Rounded sum = two_sum(value, square.value);
    value = sum.value;
    rest += sum.rest + (square.rest + 2 * difference.value * difference.rest);
  }
  const Rounded total = two_sum(value, rest);
  const double rounding = 0x1p-104 * largest(high_);
  const double length = std::sqrt(total.value) + rounding;
  return {total.value, total.rest, 0x1p-96 * total.value + 8 * rounding * length + kUnderflowError};
}

Rational CentreDistances::exact(const PointRef& p) const {
  const RationalVec3 d = p.rational() - centre_;
  return dot(d, d);
}

int compare(const CentreDistances::Estimate& a, const CentreDistances::Estimate& b) {
  const double difference = (a.value - b.value) + (a.rest - b.rest);
  // The difference itself has two roundings.
  const double error = (a.error + b.error + 0x1p-51 * std::abs(difference)) + 0x1p-104 * (a.value + b.value);
  if (difference > error) return 1;
  if (difference < -error) return -1;
  return kUndecided;
}

CentreDistances::Estimate estimate_of(const Rational& number) {
  const double value = number.nearest_double();
  if (!std::isfinite(value)) return {value, 0, value};
  return {value, (number - Rational(value)).nearest_double(), 0x1p-104 * std::abs(value) + kUnderflowError};
}

}  // namespace algebra3d::detail
