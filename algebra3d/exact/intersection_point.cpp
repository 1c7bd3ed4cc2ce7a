#include "algebra3d/exact/intersection_point.h"

#include <array>

#include "algebra3d/exact/rational_big.h"

namespace algebra3d {
namespace {

using detail::BigInteger;
using detail::HomogeneousPoint;

Rational quotient(mpz_srcptr numerator, mpz_srcptr denominator) {
  RationalAccess::Owner result = RationalAccess::make();
  mpz_set(mpq_numref(result->value), numerator);
  mpz_set(mpq_denref(result->value), denominator);
  mpq_canonicalize(result->value);
  return RationalAccess::take(std::move(result));
}

ExactPoint point_at(const HomogeneousPoint& p) {
  return ExactPoint(RationalVec3(quotient(p.x, p.w), quotient(p.y, p.w), quotient(p.z, p.w)));
}

bool is_one(mpz_srcptr number) {
  return mpz_cmp_ui(number, 1) == 0;
}

/// The value of a plane's equation at a point.
void evaluate(mpz_ptr result, const HomogeneousPoint& plane, const HomogeneousPoint& point) {
  mpz_mul(result, plane.x, point.x);
  for (std::size_t i = 1; i < 4; ++i) mpz_addmul(result, plane[i], point[i]);
}

}  // namespace

void IntegerPlane::reduce() {
  thread_local BigInteger divisor;
  mpz_gcd(divisor, numbers_.x, numbers_.y);
  for (std::size_t i = 2; i < 4; ++i)
    if (!is_one(divisor)) mpz_gcd(divisor, divisor, numbers_[i]);
  if (is_one(divisor)) return;
  for (std::size_t i = 0; i < 4; ++i) mpz_divexact(numbers_[i], numbers_[i], divisor);
}

IntegerPlane IntegerPlane::through(const TriangleRef& triangle) {
  thread_local std::array<HomogeneousPoint, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i].set(triangle[i]);
  IntegerPlane plane;
  detail::join(plane.numbers_, corners[0], corners[1], corners[2]);
  plane.reduce();
  return plane;
}

IntegerPlane IntegerPlane::along_axis(PointRef p, PointRef q, std::size_t axis) {
  thread_local std::array<HomogeneousPoint, 3> points;
  points[0].set(p);
  points[1].set(q);
  // The point of the axis at infinity.
  for (std::size_t i = 0; i < 4; ++i) mpz_set_ui(points[2][i], i == axis ? 1 : 0);
  IntegerPlane plane;
  detail::join(plane.numbers_, points[0], points[1], points[2]);
  plane.reduce();
  return plane;
}

ExactPlane IntegerPlane::exact() const {
  thread_local BigInteger one;
  mpz_set_ui(one, 1);
  return {RationalVec3(quotient(numbers_.x, one), quotient(numbers_.y, one), quotient(numbers_.z, one)),
          -quotient(numbers_.w, one)};
}

bool operator==(const IntegerPlane& a, const IntegerPlane& b) {
  for (std::size_t i = 0; i < 4; ++i)
    if (mpz_cmp(a.numbers_[i], b.numbers_[i]) != 0) return false;
  return true;
}

ExactPoint intersect_line_plane(PointRef a, PointRef b, const IntegerPlane& plane) {
  thread_local HomogeneousPoint from, to, met;
  thread_local BigInteger at_from, at_to;
  from.set(a);
  to.set(b);
  evaluate(at_from, plane.numbers_, from);
  evaluate(at_to, plane.numbers_, to);
  // The combination of the two points at which the equation holds.
  for (std::size_t i = 0; i < 4; ++i) {
    mpz_mul(met[i], at_to, from[i]);
    mpz_submul(met[i], at_from, to[i]);
  }
  return point_at(met);
}

ExactPoint intersect_planes(const IntegerPlane& p, const IntegerPlane& q, const IntegerPlane& r) {
  thread_local HomogeneousPoint met;
  detail::join(met, p.numbers_, q.numbers_, r.numbers_);
  return point_at(met);
}

}  // namespace algebra3d
