#include "algebra3d/kernel/exact/detail/fixed_width.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "algebra3d/kernel/exact/detail/exact_sum_wide.h"
#include "algebra3d/kernel/exact/detail/predicates_integers.h"

namespace algebra3d::detail {
namespace {

/// Coordinates by axes: those of point i are axes[0].integers[i] * 2^axes[0].exponent, and so on.
template <std::size_t Count>
using ScaledPoints = std::array<ScaledIntegers<Count>, 3>;

template <std::size_t Count>
std::optional<ScaledPoints<Count>> scale(const std::array<Vec3, Count>& points) {
  ScaledPoints<Count> result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<double, Count> coordinates{};
    for (std::size_t i = 0; i < Count; ++i) coordinates[i] = points[i][axis];
    const auto scaled = scale_to_integers<Count>(coordinates);
    if (!scaled) return std::nullopt;
    result[axis] = *scaled;
  }
  return result;
}

WideInteger<1> wide(std::int64_t value) {
  return {{magnitude(value)}, value < 0};
}
WideInteger<2> wide(Int128 value) {
  const UInt128 bits = value < 0 ? -static_cast<UInt128>(value) : static_cast<UInt128>(value);
  return {{static_cast<std::uint64_t>(bits), static_cast<std::uint64_t>(bits >> 64U)}, value < 0};
}
template <std::size_t Limbs, std::size_t Fewer>
WideInteger<Limbs> widened(const WideInteger<Fewer>& number) {
  WideInteger<Limbs> result;
  std::ranges::copy(number.limbs, result.limbs.begin());
  result.is_negative = number.is_negative;
  return result;
}

using Normal = std::array<WideInteger<2>, 3>;

/// (q - p) x (r - p), for the points with these numbers.
template <std::size_t Count>
Normal normal_of(const ScaledPoints<Count>& points, std::size_t p, std::size_t q, std::size_t r) {
  Normal normal;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& y = points[(axis + 1) % 3].integers;
    const auto& z = points[(axis + 2) % 3].integers;
    normal[axis] =
        wide(Int128{y[q] - y[p]} * Int128{z[r] - z[p]} - Int128{z[q] - z[p]} * Int128{y[r] - y[p]});  // below 2^123
  }
  return normal;
}

/// The scalar product with a vector below 2^61: below 2^186.
WideInteger<3> dot(const Normal& normal, const std::array<std::int64_t, 3>& vector) {
  WideSum<3> sum;
  for (std::size_t axis = 0; axis < 3; ++axis) sum.add(normal[axis] * wide(vector[axis]));
  return sum.total();
}

template <std::size_t Count>
WideInteger<3> height(const Normal& normal, const ScaledPoints<Count>& points, std::size_t point, std::size_t origin) {
  std::array<std::int64_t, 3> vector{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    vector[axis] = points[axis].integers[point] - points[axis].integers[origin];
  return dot(normal, vector);
}

/// An integer times a power of two.
struct Term {
  WideInteger<4> integer;
  int exponent;

  bool is_zero() const {
    return std::ranges::all_of(integer.limbs, [](std::uint64_t limb) { return limb == 0; });
  }
  /// The largest power of two that divides the number.
  int lowest_bit() const {
    std::size_t limb = 0;
    while (integer.limbs[limb] == 0) ++limb;
    return exponent + static_cast<int>(64 * limb) + std::countr_zero(integer.limbs[limb]);
  }
};

/// Sets the result to four numbers, divided by the powers of two that they have in common.
void set(HomogeneousPoint& result, const std::array<Term, 4>& terms) {
  int common = std::numeric_limits<int>::max();
  for (const Term& term : terms)
    if (!term.is_zero()) common = std::min(common, term.lowest_bit());
  for (std::size_t i = 0; i < 4; ++i) {
    set_integer(result[i], terms[i].integer);
    const int shift = terms[i].exponent - common;
    if (shift > 0)
      mpz_mul_2exp(result[i], result[i], static_cast<mp_bitcnt_t>(shift));
    else if (shift < 0)
      mpz_tdiv_q_2exp(result[i], result[i], static_cast<mp_bitcnt_t>(-shift));
  }
}

}  // namespace

bool join_in_fixed_width(HomogeneousPoint& result, const std::array<Vec3, 3>& points) {
  const auto scaled = scale(points);
  if (!scaled) return false;
  const Normal normal = normal_of(*scaled, 0, 1, 2);
  WideInteger<3> offset = dot(normal, {(*scaled)[0].integers[0], (*scaled)[1].integers[0], (*scaled)[2].integers[0]});
  offset.is_negative = !offset.is_negative;
  // The normal is in units of 2^(y + z), 2^(z + x), 2^(x + y), and multiplies coordinates in units of 2^x, 2^y, 2^z.
  set(result, {Term{widened<4>(normal[0]), -(*scaled)[0].exponent}, Term{widened<4>(normal[1]), -(*scaled)[1].exponent},
               Term{widened<4>(normal[2]), -(*scaled)[2].exponent}, Term{widened<4>(offset), 0}});
  return true;
}

bool meet_in_fixed_width(HomogeneousPoint& result, const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& triangle) {
  const auto scaled = scale<5>({triangle[0], triangle[1], triangle[2], a, b});
  if (!scaled) return false;
  constexpr std::size_t kA = 3, kB = 4;
  const Normal normal = normal_of(*scaled, 0, 1, 2);
  // The ratio of the heights does not depend on the units. The point is (height_a * b - height_b * a) / (height_a -
  // height_b).
  const WideInteger<3> height_a = height(normal, *scaled, kA, 0), height_b = height(normal, *scaled, kB, 0);
  std::array<Term, 4> terms{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& [integers, exponent] = (*scaled)[axis];
    WideSum<4> sum;  // below 2^247
    sum.add(height_a * wide(integers[kB])).subtract(height_b * wide(integers[kA]));
    terms[axis] = {sum.total(), exponent};
  }
  terms[3] = {widened<4>(WideSum<3>().add(height_a).subtract(height_b).total()), 0};
  set(result, terms);
  return true;
}

}  // namespace algebra3d::detail
