#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <gmpxx.h>

#include "algebra3d/kernel/exact/detail/exact_sum_wide.h"

namespace algebra3d::detail {

/// The pairs of axes of second moments: xx, yy, zz, yz, zx, xy.
inline constexpr std::array<std::array<std::size_t, 2>, 6> kAxisPairs{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {2, 0}, {0, 1}}};

/// Sums over triangles whose coordinates are integers of at most 64 * Limbs - 4 bits on each axis.
template <std::size_t Limbs>
class FixedSums {
 public:
  using Point = std::array<WideInteger<Limbs>, 3>;

  explicit FixedSums(std::vector<Point> points) : points_(std::move(points)) {}

  template <int kDegree>
  void add(const std::array<std::uint32_t, 3>& t) {
    const Point &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
    // With k = 64 * Limbs - 4 bits per coordinate, a minor has 2k + 1 and the determinant 3k + 3.
    WideSum<3 * Limbs> determinant;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      determinant.add(a[i] * WideSum<2 * Limbs>().add(b[j] * c[k]).subtract(b[k] * c[j]).total());
    }
    const WideInteger<3 * Limbs> product = determinant.total();
    volume_.add(product);
    if constexpr (kDegree >= 1) {
      Point sum;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        sum[axis] = WideSum<Limbs>().add(a[axis]).add(b[axis]).add(c[axis]).total();
        moments_[axis].add(product * sum[axis]);
      }
      if constexpr (kDegree >= 2) add_second(product, sum, t);
    }
  }
  void get_volume(mpz_class& result) const { set_integer(result.get_mpz_t(), volume_.total()); }
  void get_moment(std::size_t axis, mpz_class& result) const {
    set_integer(result.get_mpz_t(), moments_[axis].total());
  }
  void get_second_moment(std::size_t pair, mpz_class& result) const {
    set_integer(result.get_mpz_t(), second_[pair].total());
  }

 private:
  /// The factor of the determinant has 2k + 4 bits.
  void add_second(const WideInteger<3 * Limbs>& determinant, const Point& sum, const std::array<std::uint32_t, 3>& t) {
    for (std::size_t pair = 0; pair < kAxisPairs.size(); ++pair) {
      const auto [i, j] = kAxisPairs[pair];
      WideSum<2 * Limbs> factor;
      factor.add(sum[i] * sum[j]);
      for (const std::uint32_t corner : t) factor.add(points_[corner][i] * points_[corner][j]);
      second_[pair].add(determinant * factor.total());
    }
  }

  std::vector<Point> points_;
  // One limb more for the number of triangles.
  WideSum<3 * Limbs + 1> volume_;
  std::array<WideSum<4 * Limbs + 1>, 3> moments_;
  std::array<WideSum<5 * Limbs + 1>, 6> second_;
};

}  // namespace algebra3d::detail
