#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/exact/detail/bounded_pair.h"
#include "algebra3d/kernel/exact/expansion.h"
#include "algebra3d/kernel/exact/rational.h"

namespace algebra3d::detail {

/// The sum of the lengths of triangles' normals, twice the areas, as a sum of two doubles with a bound on its error:
/// the filter of nearest_area. The relative error stays below 2^-97 of the terms of a normal, so only sums very close
/// to the middle between two doubles stay undecided. In the bounds, u = 2^-53 is the rounding of one operation; all
/// hold in rounding to nearest, without overflow and underflow, of which `is_in_range` is the guarantee. Source:
/// [dekker1971] for arithmetic with pairs of doubles.
class LengthEstimate {
 public:
  /// True for coordinates for which no operation below over- or underflows: differences are multiples of 2^-152 below
  /// 2^201, so squares of normals are multiples of 2^-608 below 2^807.
  static bool is_in_range(double coordinate) {
    const double size = std::abs(coordinate);
    return size == 0 || (size >= 0x1p-100 && size <= 0x1p200);
  }

  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    std::array<Pair, 3> v, w;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      v[axis] = two_sum(b[axis], -a[axis]);
      w[axis] = two_sum(c[axis], -a[axis]);
    }
    std::array<Pair, 3> normal;
    for (std::size_t i = 0; i < 3; ++i)
      normal[i] = minor(v[(i + 1) % 3], w[(i + 2) % 3], v[(i + 2) % 3], w[(i + 1) % 3]);
    add_length(length_of(normal));
  }

  /// Adds a triangle whose coordinates are known up to errors.
  void add(const std::array<BoundedPair, 3>& a, const std::array<BoundedPair, 3>& b,
           const std::array<BoundedPair, 3>& c) {
    std::array<BoundedPair, 3> v, w;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      v[axis] = b[axis] - a[axis];
      w[axis] = c[axis] - a[axis];
    }
    BoundedPair square;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      const BoundedPair coordinate = v[j] * w[k] - v[k] * w[j];
      square = square + coordinate * coordinate;
    }
    BoundedPair length;
    if (square.value > 4 * square.error) {
      length = root_of(square);
    } else {  // anything from 0 to the root of the bound
      length.value = std::sqrt(square.largest()) / 2;
      length.error = length.value * (1 + 0x1p-50);
    }
    error_ += length.error;
    add_length({length.value, length.rest});
  }

  /// Bounds of the sum.
  Rational lower() const { return sum() - Rational(error()); }
  Rational upper() const { return sum() + Rational(error()); }

 private:
  using Pair = Rounded;  // value + rest, |rest| <= u |value|

  Rational sum() const { return Rational(sum_.value) + Rational(sum_.rest); }
  /// Each step has an error of at most 6 u^2 of the sum; summing the errors is rounded, too.
  double error() const { return (error_ + static_cast<double>(count_) * 0x1p-103 * sum_.value) * (1 + 0x1p-20); }

  static Pair renormalised(double value, double rest) { return two_sum(value, rest); }

  /// A product with a rest of up to 3 u of it and an error below 8 u^2.
  static Pair product(const Pair& a, const Pair& b) {
    const Rounded exact = two_product(a.value, b.value, split(b.value));
    return {exact.value, exact.rest + (a.value * b.rest + a.rest * b.value)};
  }

  /// p q - r s. The products have errors of 8 u^2, the difference of the rests less than 16 u^2 more: 2^-101 of both
  /// together.
  Pair minor(const Pair& p, const Pair& q, const Pair& r, const Pair& s) {
    const Pair left = product(p, q), right = product(r, s);
    error_ += 0x1p-100 * (std::abs(left.value) + std::abs(right.value));
    const Rounded difference = two_sum(left.value, -right.value);
    return renormalised(difference.value, difference.rest + (left.rest - right.rest));
  }

  /// A square, with a rest of up to 3 u of it and an error below 6 u^2.
  static Pair square(const Pair& a) {
    const Rounded exact = two_product(a.value, a.value, split(a.value));
    return {exact.value, exact.rest + 2 * (a.value * a.rest)};
  }

  /// The sum of the squares has an error below 30 u^2, and the root, by one Newton step from its rounding, 16 u^2 more:
  /// together below 2^-100.
  Pair length_of(const std::array<Pair, 3>& normal) {
    const Pair x = square(normal[0]), y = square(normal[1]), z = square(normal[2]);
    const Rounded xy = two_sum(x.value, y.value), xyz = two_sum(xy.value, z.value);
    const Pair sum = renormalised(xyz.value, ((xy.rest + xyz.rest) + (x.rest + y.rest)) + z.rest);
    if (!(sum.value > 0)) return {0, 0};  // all three are 0, up to their errors
    const double root = std::sqrt(sum.value);
    const Rounded squared = two_product(root, root, split(root));
    const double missing = ((sum.value - squared.value) - squared.rest) + sum.rest;
    error_ += 0x1p-99 * root;
    return renormalised(root, missing / (2 * root));
  }

  void add_length(const Pair& length) {
    const Rounded sum = two_sum(sum_.value, length.value);
    sum_ = renormalised(sum.value, sum_.rest + (sum.rest + length.rest));
    ++count_;
  }

  Pair sum_{0, 0};
  double error_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace algebra3d::detail
