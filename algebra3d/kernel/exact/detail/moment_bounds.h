#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include <gmpxx.h>

#include "algebra3d/kernel/exact/detail/exact_coordinates.h"
#include "algebra3d/kernel/exact/detail/exact_sum_integers.h"
#include "algebra3d/kernel/exact/detail/fixed_sums.h"
#include "algebra3d/kernel/exact/exact_sum.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d::detail {

// Sums with exact denominators take long where corners are not doubles: the denominators of all of them come together.
// But their rounding needs no more than coordinates that are cut off to many bits and a bound of the change.

/// Two bounds of a number that is not known exactly.
struct Bounds {
  Rational lower, upper;

  /// The double nearest to all numbers between them, if it is the same.
  std::optional<double> nearest_double() const {
    const double nearest = lower.nearest_double();
    return nearest == upper.nearest_double() ? std::optional(nearest) : std::nullopt;
  }
  bool has_zero() const { return lower.sign() * upper.sign() <= 0; }
};

/// The divisor must not have zero.
inline Bounds operator/(const Bounds& a, const Bounds& b) {
  const auto [lower, upper] = std::minmax({a.lower / b.lower, a.lower / b.upper, a.upper / b.lower, a.upper / b.upper});
  return {lower, upper};
}

/// The sums of exact_sum.h, as far as the degree goes; the pairs of axes as in kAxisPairs.
struct MomentBounds {
  Bounds volume;
  std::array<Bounds, 3> first;
  std::array<Bounds, 6> second;
};

/// Points with coordinates that are cut off to integers times a power of two, one for each axis, by less than one. The
/// integers are at most 2^kBits, what FixedSums can take.
template <std::size_t Limbs>
class CutPoints {
 public:
  static constexpr int kBits = 64 * static_cast<int>(Limbs) - 5;

  explicit CutPoints(const PointArray& points) : points_(points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      BitRange range;
      for (const Vec3& p : points.approx()) range.extend(p[axis]);
      exponents_[axis] = range.is_empty() ? 0 : range.highest - kBits;
    }
  }

  int exponent(std::size_t axis) const { return exponents_[axis]; }
  std::vector<typename FixedSums<Limbs>::Point> integers() const {
    constexpr std::size_t kPointsPerTask = 2'000;
    std::vector<typename FixedSums<Limbs>::Point> result(points_.size());
    parallel_for(result.size(), kPointsPerTask, [&](std::size_t i) {
      for (std::size_t axis = 0; axis < 3; ++axis) result[i][axis] = integer(points_[i], axis);
    });
    return result;
  }

 private:
  WideInteger<Limbs> integer(const PointRef& point, std::size_t axis) const {
    thread_local mpz_class quotient, divisor;  // NOLINT(misc-const-correctness): set through their pointers
    mpz_ptr q = quotient.get_mpz_t();
    const int exponent = exponents_[axis];
    if (point.is_double()) {
      const IntegerDouble number(point.approx[axis]);
      mpz_set_si(q, number.mantissa);
      shift(q, number.exponent - exponent);
    } else {
      mpz_set(q, (*point.exact)[axis]);
      mpz_set(divisor.get_mpz_t(), (*point.exact)[3]);
      if (exponent < 0)
        shift(q, -exponent);
      else
        shift(divisor.get_mpz_t(), exponent);
      mpz_tdiv_q(q, q, divisor.get_mpz_t());
    }
    WideInteger<Limbs> result;
    result.is_negative = mpz_sgn(q) < 0;
    for (std::size_t limb = 0; limb < Limbs; ++limb) result.limbs[limb] = mpz_getlimbn(q, static_cast<mp_size_t>(limb));
    return result;
  }
  static void shift(mpz_ptr number, int bits) {
    if (bits >= 0)
      mpz_mul_2exp(number, number, static_cast<mp_bitcnt_t>(bits));
    else
      mpz_tdiv_q_2exp(number, number, static_cast<mp_bitcnt_t>(-bits));
  }

  const PointArray& points_;
  std::array<int, 3> exponents_{};
};

/// The bounds around sum * 2^exponent / divisor, for a sum that is off by error at most.
inline Bounds bounds_of(const mpz_class& sum, const mpz_class& error, long exponent, unsigned long divisor) {
  return {scaled_rational(sum - error, exponent, divisor), scaled_rational(sum + error, exponent, divisor)};
}

// With integers of at most K = 2^k, each off by one at most, a determinant (six products of three) is at most 6 K^3 and
// off by 18 K^2 at most; the sum of three coordinates is at most 3 K and off by 3, so its product with the determinant
// is off by 54 K^3 + 18 K^3 at most. A product of two sums and three products of coordinates are together at most 12
// K^2 and off by 24 K, so their product with the determinant is off by 144 K^4 + 216 K^4 at most.
template <int kDegree, std::size_t Limbs>
Result<MomentBounds> moment_bounds(const PointArray& points, IndexTriangles triangles,
                                   const std::atomic<bool>* cancel) {
  const CutPoints<Limbs> cut(points);
  FixedSums<Limbs> sums(cut.integers());
  A3D_TRY(for_each_triangle(triangles, cancel,
                            [&](const std::array<std::uint32_t, 3>& t) { sums.template add<kDegree>(t); }));
  constexpr auto kBits = static_cast<mp_bitcnt_t>(CutPoints<Limbs>::kBits);
  const mpz_class count(static_cast<unsigned long>(triangles.size()));
  const long exponent = long{cut.exponent(0)} + cut.exponent(1) + cut.exponent(2);
  mpz_class total;
  sums.get_volume(total);
  MomentBounds result{bounds_of(total, (18 * count) << 2 * kBits, exponent, 6), {}, {}};
  if constexpr (kDegree >= 1) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sums.get_moment(axis, total);
      result.first[axis] = bounds_of(total, (72 * count) << 3 * kBits, exponent + cut.exponent(axis), 24);
    }
  }
  if constexpr (kDegree >= 2) {
    for (std::size_t pair = 0; pair < kAxisPairs.size(); ++pair) {
      const auto [i, j] = kAxisPairs[pair];
      sums.get_second_moment(pair, total);
      result.second[pair] =
          bounds_of(total, (360 * count) << 4 * kBits, exponent + cut.exponent(i) + cut.exponent(j), 120);
    }
  }
  return result;
}

/// Bits that nearly always suffice, and those that do but for a result that is tiny beside the coordinates.
inline constexpr std::size_t kFewLimbs = 2, kManyLimbs = 5;

}  // namespace algebra3d::detail
