#include "algebra3d/kernel/exact/affine_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "algebra3d/kernel/exact/trigonometry.h"

namespace algebra3d {

namespace {

using Rows = std::array<RationalVec3, 3>;

RationalVec3 product(const Rows& rows, const RationalVec3& v) {
  return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
}

RationalVec3 column(const Rows& rows, std::size_t index) {
  return {rows[0][index], rows[1][index], rows[2][index]};
}

Rows diagonal(const RationalVec3& factors) {
  return {RationalVec3(factors.x, 0, 0), RationalVec3(0, factors.y, 0), RationalVec3(0, 0, factors.z)};
}

// The matrix of the quaternion (w, v), of any length: [(w^2 - |v|^2) I + 2 v v^T + 2 w [v]x] / (w^2 + |v|^2). It is
// orthogonal with determinant 1 and fixes v, whatever w and v are.
Rows rows_of_quaternion(const Rational& w, const RationalVec3& v) {
  const Rational squared_length = dot(v, v);
  const Rational scale = Rational(1) / (w * w + squared_length);
  const Rational straight = (w * w - squared_length) * scale;
  const RationalVec3 along = (scale * 2) * v;
  const RationalVec3 turn = w * along;
  const auto entry = [&](std::size_t i, std::size_t j) { return along[i] * v[j]; };
  return {RationalVec3(entry(0, 0) + straight, entry(0, 1) - turn.z, entry(0, 2) + turn.y),
          RationalVec3(entry(1, 0) + turn.z, entry(1, 1) + straight, entry(1, 2) - turn.x),
          RationalVec3(entry(2, 0) - turn.y, entry(2, 1) + turn.x, entry(2, 2) + straight)};
}

Rows cofactors(const Rows& rows) {
  return {cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])};
}

}  // namespace

AffineMap::AffineMap(std::array<RationalVec3, 3> rows, RationalVec3 shift)
    : rows_(std::move(rows)),
      shift_(std::move(shift)),
      split_{split(rows_[0], shift_.x), split(rows_[1], shift_.y), split(rows_[2], shift_.z)} {}

AffineMap AffineMap::translation(const RationalVec3& by) {
  return {diagonal({1, 1, 1}), by};
}

AffineMap AffineMap::scaling(const RationalVec3& centre, const RationalVec3& factors) {
  Rows rows = diagonal(factors);
  RationalVec3 shift = centre - product(rows, centre);
  return {std::move(rows), std::move(shift)};
}

// x - 2 (x.n - c) / (n.n) n
AffineMap AffineMap::reflection(const ExactPlane& plane) {
  const RationalVec3& n = plane.normal;
  const RationalVec3 scaled = (Rational(2) / dot(n, n)) * n;
  return {{RationalVec3(1, 0, 0) - n.x * scaled, RationalVec3(0, 1, 0) - n.y * scaled,
           RationalVec3(0, 0, 1) - n.z * scaled},
          plane.offset * scaled};
}

std::optional<AffineMap> AffineMap::rotation(const RationalVec3& centre, const RationalVec3& axis,
                                             double angle_degrees) {
  if (is_zero(axis)) return std::nullopt;
  // Shortest integers for the direction keep the entries short, and make the result independent of the axis's length.
  const RationalVec3 direction = primitive_direction(axis);
  const std::optional<Rational> ratio = half_angle_ratio(angle_degrees, dot(direction, direction));
  Rows rows = ratio ? rows_of_quaternion(1, *ratio * direction) : rows_of_quaternion(0, direction);
  RationalVec3 shift = centre - product(rows, centre);
  return AffineMap(std::move(rows), std::move(shift));
}

Rational AffineMap::determinant() const {
  return dot(rows_[0], cross(rows_[1], rows_[2]));
}

// |x| = |M^-1 Mx| <= |M^-1| |Mx|, and the Frobenius norm of M^-1, which is at most sqrt(3) times its norm, is that of
// the cofactors over the determinant.
double AffineMap::least_stretch() const {
  double squares = 0;
  for (const RationalVec3& row : cofactors(rows_))
    for (std::size_t i = 0; i < 3; ++i) squares += std::pow(row[i].abs().upper_double(), 2);
  const double stretch = determinant().abs().lower_double() / std::sqrt(squares) * (1 - 0x1p-40);
  return std::isfinite(squares) && std::isnormal(squares) && std::isnormal(stretch) ? stretch : 0;
}

// An orthogonal matrix of dyadic numbers has integer entries, and is so a signed permutation: were 2^k, k > 0, the
// common denominator of a row in lowest terms, its three numerators would have 4^k as the sum of their squares; but a
// sum of three squares is a multiple of 4 only if all three numbers are even.
bool AffineMap::has_dyadic_matrix() const {
  return std::ranges::all_of(
      rows_, [](const RationalVec3& row) { return row.x.is_dyadic() && row.y.is_dyadic() && row.z.is_dyadic(); });
}

RationalVec3 AffineMap::apply(const RationalVec3& point) const {
  return product(rows_, point) + shift_;
}

std::optional<ExactPoint> AffineMap::apply(const ExactPoint& point) const {
  const Vec3 rounded = apply_rounded(point);
  if (!is_finite(rounded)) return std::nullopt;
  if (image_is_double(point, rounded)) return ExactPoint(rounded);
  ExactPoint image(apply(point.rational()));
  // Beyond the largest double there is a bit that is rounded to it.
  const Box3 box = box_of(image);
  if (!is_finite(box.min) || !is_finite(box.max)) return std::nullopt;
  return image;
}

// With C the matrix of cofactors, det M * M^-T: (Mx).(Cn) = det M (x.n), so y.(Cn) - c' = det M (x.n - c) for y = Mx +
// t and c' = det M c + t.(Cn). The sign of det M turns the positive side to where it belongs.
ExactPlane AffineMap::apply(const ExactPlane& plane) const {
  const Rational factor = determinant();
  assert(factor.sign() != 0);
  const RationalVec3 normal = Rational(factor.sign()) * product(cofactors(rows_), plane.normal);
  return {normal, factor.abs() * plane.offset + dot(shift_, normal)};
}

AffineMap AffineMap::then(const AffineMap& next) const {
  const Rows columns = {column(rows_, 0), column(rows_, 1), column(rows_, 2)};
  return {{product(columns, next.rows_[0]), product(columns, next.rows_[1]), product(columns, next.rows_[2])},
          next.apply(shift_)};
}

}  // namespace algebra3d
