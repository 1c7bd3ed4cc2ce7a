#pragma once

#include <cmath>
#include <optional>

#include "algebra3d/kernel/exact/expansion.h"
#include "algebra3d/kernel/exact/rational.h"

namespace algebra3d::detail {

/// A number known up to an error: value + rest, off by `error` at most. The error is 0 where all operations were exact,
/// so that zeros are recognised. Holds in rounding to nearest without overflow and underflow, of which `is_in_range` of
/// LengthEstimate is the guarantee. In the bounds, u = 2^-53 is the rounding of one operation. Source: [dekker1971] for
/// arithmetic with pairs of doubles.
struct BoundedPair {
  double value = 0;
  double rest = 0;  ///< at most u of the value, so that the value is value + rest rounded
  double error = 0;

  static BoundedPair difference(double a, double b) {
    const auto [value, rest] = two_sum(a, -b);
    return {value, rest, 0};
  }
  BoundedPair operator-() const { return {-value, -rest, error}; }
  double size() const { return std::abs(value); }
  /// A bound on the magnitude of the number.
  double largest() const { return size() * (1 + 0x1p-50) + error; }
  bool is_zero() const { return value == 0 && rest == 0 && error == 0; }

  /// The number rounded once; nothing if the error leaves the rounding open.
  std::optional<double> nearest_double() const {
    if (error == 0) return value;
    // The second term covers the rounding of the two sums with the rest.
    const double slack = 1.25 * error + 0x1p-104 * size();
    const double low = value + (rest - slack), high = value + (rest + slack);
    if (low == high) return low;
    return std::nullopt;
  }
};

/// The rests are added with an error of 4 u^2 of both numbers, unless there is nothing to round.
inline BoundedPair operator+(const BoundedPair& a, const BoundedPair& b) {
  const Rounded sum = two_sum(a.value, b.value);
  const auto [value, rest] = two_sum(sum.value, sum.rest + (a.rest + b.rest));
  const bool is_exact = (a.rest == 0 && b.rest == 0) || a.rest == -b.rest;
  return {value, rest, a.error + b.error + (is_exact ? 0 : 0x1p-103 * (a.size() + b.size()))};
}
inline BoundedPair operator-(const BoundedPair& a, const BoundedPair& b) {
  return a + -b;
}

/// The product has an error of 8 u^2, unless both are doubles.
inline BoundedPair operator*(const BoundedPair& a, const BoundedPair& b) {
  const Rounded product = two_product(a.value, b.value, split(b.value));
  const auto [value, rest] = two_sum(product.value, product.rest + (a.value * b.rest + a.rest * b.value));
  double error = a.rest == 0 && b.rest == 0 ? 0 : 0x1p-102 * std::abs(value);
  if (a.error != 0 || b.error != 0) error += 1.0625 * (a.largest() * b.error + b.largest() * a.error);
  return {value, rest, error};
}

/// The quotient, by one Newton step; the divisor must be clearly off zero.
inline BoundedPair operator/(const BoundedPair& a, const BoundedPair& b) {
  const double quotient = a.value / b.value;
  const Rounded product = two_product(quotient, b.value, split(b.value));
  const double missing = ((a.value - product.value) - product.rest) + (a.rest - quotient * b.rest);
  const auto [value, rest] = two_sum(quotient, missing / b.value);
  return {value, rest, 0x1p-99 * std::abs(value) + 1.0625 * (a.error + std::abs(value) * b.error) / b.size()};
}

/// The square root of a number clearly above zero, by one Newton step; its own error is at most 16 u^2.
inline BoundedPair root_of(const BoundedPair& a) {
  const double root = std::sqrt(a.value);
  const Rounded squared = two_product(root, root, split(root));
  const double missing = ((a.value - squared.value) - squared.rest) + a.rest;
  const auto [value, rest] = two_sum(root, missing / (2 * root));
  return {value, rest, 0x1p-99 * value + a.error / value};
}

}  // namespace algebra3d::detail
