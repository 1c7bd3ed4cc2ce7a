#include "algebra3d/kernel/exact/inward_ray.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "algebra3d/kernel/exact/detail/exact_sum_wide.h"
#include "algebra3d/kernel/exact/detail/predicates_integers.h"

namespace algebra3d {
namespace {

using detail::BoundedPair;
using detail::sign_of;
using Triple = std::array<BoundedPair, 3>;

/// Products of ten coordinates, and of ten of their last bits, are within the range of doubles.
bool has_moderate_size(const PointRef& point) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double size = std::abs(point.approx[axis]);
    if (size != 0 && !(size >= 0x1p-40 && size <= 0x1p60)) return false;
  }
  return true;
}

Triple cross(const Triple& a, const Triple& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
BoundedPair dot(const Triple& a, const Triple& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

BoundedPair difference(const PointRef& a, const PointRef& b, std::size_t axis) {
  if (a.is_double() && b.is_double()) return BoundedPair::difference(a.approx[axis], b.approx[axis]);
  return detail::pair_of(a, axis) - detail::pair_of(b, axis);
}

Triple difference(const PointRef& a, const PointRef& b) {
  return {difference(a, b, 0), difference(a, b, 1), difference(a, b, 2)};
}

bool is_known(const BoundedPair& number) {
  return number.size() > 0x1p60 * number.error;
}

/// Integers of any number of limbs, as far as signs of determinants need them.
template <std::size_t Limbs>
using Wide = detail::WideInteger<Limbs>;

Wide<1> wide(std::int64_t value) {
  Wide<1> result;
  result.limbs[0] = magnitude(value);
  result.is_negative = value < 0;
  return result;
}

template <std::size_t Limbs>
int sign_of(const Wide<Limbs>& number) {
  const bool is_zero = std::ranges::all_of(number.limbs, [](std::uint64_t limb) { return limb == 0; });
  return is_zero ? 0 : number.is_negative ? -1 : 1;
}

using IntegerVector = std::array<std::int64_t, 3>;

std::array<Wide<2>, 3> wide_cross(const IntegerVector& a, const IntegerVector& b) {
  std::array<Wide<2>, 3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    result[i] = detail::WideSum<2>().add(wide(a[j]) * wide(b[k])).subtract(wide(a[k]) * wide(b[j])).total();
  }
  return result;
}

int sign_of_dot(const std::array<Wide<2>, 3>& a, const std::array<Wide<2>, 3>& b) {
  detail::WideSum<5> sum;
  for (std::size_t i = 0; i < 3; ++i) sum.add(a[i] * b[i]);
  return sign_of(sum.total());
}

/// Sides as in Meeting, by integers below 2^57 times one power of two: with those of three points of the ray's triangle
/// and three of the other. Nothing if the coordinates are not such integers.
std::optional<std::array<int, 3>> sides_by_integers(const TriangleRef& of_ray, const TriangleRef& triangle) {
  std::array<double, 18> coordinates{};
  for (std::size_t i = 0; i < 6; ++i) {
    const PointRef& point = i < 3 ? of_ray[i] : triangle[i - 3];
    if (!point.is_double()) return std::nullopt;
    for (std::size_t axis = 0; axis < 3; ++axis) coordinates[3 * i + axis] = point.approx[axis];
  }
  const auto scaled = detail::scale_to_integers<18>(coordinates);
  if (!scaled) return std::nullopt;
  // Six times such numbers fit 63 bits. They mostly end in zeros.
  const bool have_zeros = std::ranges::all_of(scaled->integers, [](std::int64_t n) { return n % 8 == 0; });
  const std::int64_t divisor = have_zeros ? 8 : 1;
  std::array<IntegerVector, 6> points{};
  for (std::size_t i = 0; i < 18; ++i) {
    points[i / 3][i % 3] = scaled->integers[i] / divisor;
    if (std::abs(points[i / 3][i % 3]) >= std::int64_t{1} << 57) return std::nullopt;
  }
  IntegerVector u{}, v{};
  std::array<IntegerVector, 3> from_origin{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    u[axis] = points[1][axis] - points[0][axis];
    v[axis] = points[2][axis] - points[0][axis];
    const std::int64_t sum = points[0][axis] + points[1][axis] + points[2][axis];
    for (std::size_t i = 0; i < 3; ++i) from_origin[i][axis] = 3 * points[3 + i][axis] - sum;
  }
  const std::array<Wide<2>, 3> normal = wide_cross(v, u);
  std::array<int, 3> sides{};
  for (std::size_t i = 0; i < 3; ++i)
    sides[i] = sign_of_dot(normal, wide_cross(from_origin[i], from_origin[(i + 1) % 3]));
  return sides;
}

}  // namespace

bool InwardRay::Meeting::is_met() const {
  const auto has = [this](int sign) { return std::ranges::find(sides, sign) != sides.end(); };
  return !(has(1) && has(-1));
}

std::optional<int> InwardRay::Meeting::direction() const {
  const int sign = sign_of(over);
  return sign == detail::kUndecided ? std::nullopt : std::optional(sign);
}

std::optional<InwardRay> InwardRay::from(const TriangleRef& triangle) {
  if (!std::ranges::all_of(triangle, has_moderate_size)) return std::nullopt;
  InwardRay ray(triangle);
  const auto& [a, b, c] = triangle;
  ray.normal_ = cross(difference(c, a), difference(b, a));
  const BoundedPair square = dot(ray.normal_, ray.normal_);
  if (!is_known(square)) return std::nullopt;
  ray.length_ = root_of(square);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ray.direction_[axis] = ray.normal_[axis].value / ray.length_.value;
    ray.origin_[axis] = (a.approx[axis] + b.approx[axis] + c.approx[axis]) / 3;
  }
  return ray;
}

InwardRay::Triple InwardRay::thrice_from_origin(const PointRef& point) const {
  Triple result;
  for (std::size_t axis = 0; axis < 3; ++axis)
    result[axis] = difference(point, triangle_[0], axis) + difference(point, triangle_[1], axis) +
                   difference(point, triangle_[2], axis);
  return result;
}

std::optional<InwardRay::Meeting> InwardRay::meeting(const TriangleRef& triangle) const {
  if (!std::ranges::all_of(triangle, has_moderate_size)) return std::nullopt;
  const std::array<Triple, 3> corners{thrice_from_origin(triangle[0]), thrice_from_origin(triangle[1]),
                                      thrice_from_origin(triangle[2])};
  Meeting result;
  std::array<BoundedPair, 3> sides;
  std::array<Triple, 3> products;
  bool is_decided = true;
  for (std::size_t i = 0; i < 3; ++i) {
    products[i] = cross(corners[i], corners[(i + 1) % 3]);
    sides[i] = dot(normal_, products[i]);
    result.sides[i] = sign_of(sides[i]);
    is_decided = is_decided && result.sides[i] != detail::kUndecided;
  }
  if (!is_decided) {
    const auto exact = sides_by_integers(triangle_, triangle);
    if (!exact) return std::nullopt;
    result.sides = *exact;
  }
  result.under = sides[0] + sides[1] + sides[2];
  result.over = dot(corners[0], products[1]);
  const int sign = sign_of(result.under);
  if (sign == 0 || sign == detail::kUndecided) return std::nullopt;
  if (sign < 0) {
    result.under = -result.under;
    result.over = -result.over;
  }
  return result;
}

std::optional<double> InwardRay::distance(const Meeting& meeting) const {
  if (!is_known(meeting.under)) return std::nullopt;
  const BoundedPair three{3, 0, 0};
  const BoundedPair result = meeting.over * length_ / (three * meeting.under);
  return is_known(result) ? result.nearest_double() : std::nullopt;
}

std::optional<int> order_on_ray(const InwardRay::Meeting& a, const InwardRay::Meeting& b) {
  const int sign = sign_of(a.over * b.under - b.over * a.under);
  return sign == detail::kUndecided ? std::nullopt : std::optional(sign);
}

}  // namespace algebra3d
