#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "algebra3d/base/vec3.h"

namespace algebra3d::detail {

/// Arc tangent of a number from 0 to 1, within 2 ulp. From basic operations only, so that the bits do not depend on the
/// C library.
inline double arc_tangent_of_fraction(double t) {
  // atan(i / 8), rounded once.
  static constexpr std::array<double, 9> kTable = {0,
                                                   0.12435499454676144,
                                                   0.24497866312686414,
                                                   0.35877067027057225,
                                                   0.4636476090008061,
                                                   0.5585993153435624,
                                                   0.6435011087932844,
                                                   0.7188299996216245,
                                                   0.7853981633974483};
  // A table, since a quotient in the code is a division at run time where the rounding mode may differ.
  static constexpr std::array<double, 7> kReciprocals = {1.0 / 15, 1.0 / 13, 1.0 / 11, 1.0 / 9,
                                                         1.0 / 7,  1.0 / 5,  1.0 / 3};
  const auto nearest = static_cast<std::int32_t>(8 * (t + 1.0 / 16));
  const double known = static_cast<double>(nearest) * 0.125;
  const double rest = (t - known) / (1 + t * known);  // at most 1/16, so that eight terms of the series are enough
  const double square = rest * rest;
  double sum = 0;
  for (const double reciprocal : kReciprocals) sum = square * (reciprocal - sum);
  return kTable[static_cast<std::size_t>(nearest)] + (rest - rest * sum);
}

/// The angle of the direction (x, y) for y >= 0, in radians from 0 to pi, within 4 ulp; 0 for the zero vector. The same
/// bits with every C library.
inline double angle_of_direction(double y, double x) {
  constexpr double kQuarterTurn = std::numbers::pi / 2;
  const double size = std::abs(x);
  const bool is_flat = y <= size;
  const double shorter = is_flat ? y : size;
  const double longer = is_flat ? size : y;
  const double acute = arc_tangent_of_fraction(shorter / (longer == 0 ? 1 : longer));
  const double of_size = is_flat ? acute : kQuarterTurn - acute;
  return x >= 0 ? of_size : std::numbers::pi - of_size;
}

/// The angle between two vectors in radians, from 0 to pi; rounded in every operation.
inline double angle_between(const Vec3& u, const Vec3& v) {
  return angle_of_direction(length(cross(u, v)), dot(u, v));
}

inline constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

}  // namespace algebra3d::detail
