#include "algebra3d/kernel/exact/plane.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "algebra3d/kernel/exact/detail/rational_big.h"

namespace algebra3d {

std::optional<ExactPlane> ExactPlane::through(const RationalVec3& point, const RationalVec3& normal) {
  if (is_zero(normal)) return std::nullopt;
  return ExactPlane{normal, dot(point, normal)};
}

std::optional<ExactPlane> ExactPlane::spanned(const RationalVec3& point, const RationalVec3& u, const RationalVec3& v) {
  return through(point, cross(u, v));
}

std::optional<ExactPlane> ExactPlane::from_distance(double distance, const Vec3& normal) {
  if (!std::isfinite(distance) || !is_finite(normal)) return std::nullopt;
  RationalVec3 exact(normal);
  if (is_zero(exact)) return std::nullopt;
  const Rational factor(distance);
  const double offset = (factor * factor * dot(exact, exact)).nearest_root();
  if (!std::isfinite(offset)) return std::nullopt;
  return ExactPlane{std::move(exact), Rational(distance < 0 ? -offset : offset)};
}

Rational ExactPlane::evaluate(const RationalVec3& p) const {
  return dot(p, normal) - offset;
}

ExactPlane ExactPlane::canonical() const {
  RationalVec3 primitive = primitive_direction(normal);
  const std::size_t axis = normal.x.sign() != 0 ? 0 : normal.y.sign() != 0 ? 1 : 2;
  Rational scaled = offset * (primitive[axis] / normal[axis]);
  return {std::move(primitive), std::move(scaled)};
}

RationalVec3 primitive_direction(const RationalVec3& v) {
  assert(!is_zero(v));
  // common = gcd(numerators) / lcm(denominators): the largest number of which every coordinate is a multiple.
  RationalAccess::Owner common = RationalAccess::make();
  mpz_ptr divisor = mpq_numref(common->value);
  mpz_ptr multiple = mpq_denref(common->value);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const RationalAccess::View view(v[axis]);
    mpz_gcd(divisor, divisor, view.numerator());
    mpz_lcm(multiple, multiple, view.denominator());
  }
  const Rational unit = RationalAccess::take(std::move(common));
  return {v.x / unit, v.y / unit, v.z / unit};
}

bool is_zero(const RationalVec3& v) {
  return v.x.sign() == 0 && v.y.sign() == 0 && v.z.sign() == 0;
}

Rational dot(const RationalVec3& a, const RationalVec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

RationalVec3 cross(const RationalVec3& a, const RationalVec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

RationalVec3 operator+(const RationalVec3& a, const RationalVec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

RationalVec3 operator-(const RationalVec3& a, const RationalVec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

RationalVec3 operator*(const Rational& factor, const RationalVec3& v) {
  return {factor * v.x, factor * v.y, factor * v.z};
}

}  // namespace algebra3d
