#pragma once

#include <array>
#include <cmath>
#include <cstddef>
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
  const auto nearest = static_cast<std::size_t>(std::floor(8 * t + 0.5));
  const double known = static_cast<double>(nearest) / 8;
  const double rest = (t - known) / (1 + t * known);  // at most 1/16, so that eight terms of the series are enough
  const double square = rest * rest;
  double sum = 0;
  for (int degree = 15; degree >= 3; degree -= 2) sum = square * (1.0 / degree - sum);
  return kTable[nearest] + (rest - rest * sum);
}

/// The angle of the direction (x, y) for y >= 0, in radians from 0 to pi, within 4 ulp; 0 for the zero vector. The same
/// bits with every C library.
inline double angle_of_direction(double y, double x) {
  const double size = std::abs(x);
  if (y == 0 && size == 0) return 0;
  const double acute =
      y <= size ? arc_tangent_of_fraction(y / size) : std::numbers::pi / 2 - arc_tangent_of_fraction(size / y);
  return x >= 0 ? acute : std::numbers::pi - acute;
}

/// The angle between two vectors in radians, from 0 to pi; rounded in every operation.
inline double angle_between(const Vec3& u, const Vec3& v) {
  return angle_of_direction(length(cross(u, v)), dot(u, v));
}

inline constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

}  // namespace algebra3d::detail
