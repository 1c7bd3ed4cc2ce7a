#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/exact/detail/rational_big.h"

namespace algebra3d::detail {

// Determinants of doubles that are integers below 2^60 after exact scaling by one power of two. Coordinates of models
// are nearly always of this kind; a coplanar quadruple then costs a tenth of the time with expansions.

/// Doubles as integers below 2^60 times one power of two.
template <std::size_t Count>
struct ScaledIntegers {
  std::array<std::int64_t, Count> integers{};
  int exponent = 0;  ///< of the power of two
};

/// The coordinates as such integers; nothing if there is no such power.
template <std::size_t Count>
std::optional<ScaledIntegers<Count>> scale_to_integers(const std::array<double, Count>& coordinates) {
  double largest = 0;
  for (const double c : coordinates) largest = std::max(largest, std::abs(c));
  // 2^e <= largest < 2^(e+1) for normal numbers; the factor 2^(59-e) has to be normal too.
  const auto biased_exponent = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(largest) >> 52U);
  const std::int64_t biased_factor = 2 * 1023 + 59 - biased_exponent;
  if (largest == 0) return ScaledIntegers<Count>();
  if (biased_factor > 2046) return std::nullopt;
  const auto factor = std::bit_cast<double>(static_cast<std::uint64_t>(biased_factor) << 52U);
  ScaledIntegers<Count> result{{}, static_cast<int>(1023 - biased_factor)};
  std::array<std::int64_t, Count>& integers = result.integers;
  bool all_integers = true;
  for (std::size_t i = 0; i < Count; ++i) {
    const double scaled = coordinates[i] * factor;
    integers[i] = static_cast<std::int64_t>(scaled);
    // A product that underflows to 0 means a coordinate far below the common power.
    all_integers = all_integers && static_cast<double>(integers[i]) == scaled && (scaled != 0 || coordinates[i] == 0);
  }
  return all_integers ? std::optional(result) : std::nullopt;
}

/// Sign of the determinant of rows p[1] - p[0], p[2] - p[0], p[3] - p[0], given by columns; entries below 2^60.
inline int determinant_sign(const std::array<std::int64_t, 4>& x, const std::array<std::int64_t, 4>& y,
                            const std::array<std::int64_t, 4>& z) {
  const Int128 ux = x[1] - x[0], uy = y[1] - y[0], uz = z[1] - z[0];
  const Int128 vx = x[2] - x[0], vy = y[2] - y[0], vz = z[2] - z[0];
  const std::array<Int128, 3> minors{uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};  // below 2^123
  const std::array<Int128, 3> w{x[3] - x[0], y[3] - y[0], z[3] - z[0]};                         // below 2^61
  // The sum has up to 186 bits: high * 2^64 + low, neither of which overflows.
  Int128 high = 0, low = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    high += (minors[axis] >> 64) * w[axis];
    low += static_cast<Int128>(static_cast<std::uint64_t>(minors[axis])) * w[axis];
  }
  high += low >> 64;
  if (high != 0) return high > 0 ? 1 : -1;
  return static_cast<std::uint64_t>(low) != 0 ? 1 : 0;
}

inline int determinant_sign(const std::array<std::int64_t, 3>& x, const std::array<std::int64_t, 3>& y) {
  const Int128 left = static_cast<Int128>(x[1] - x[0]) * (y[2] - y[0]);
  const Int128 right = static_cast<Int128>(y[1] - y[0]) * (x[2] - x[0]);
  return left > right ? 1 : left < right ? -1 : 0;
}

}  // namespace algebra3d::detail
