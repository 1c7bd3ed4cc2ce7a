#pragma once

#include <algorithm>

namespace algebra3d {

/// The largest distance between equal corners that were rounded: 4 float spacings at the largest coordinate, or a
/// millionth of the diagonal of the file if that is larger.
inline double rounding_noise(double diagonal, double largest_coordinate) {
  constexpr double kPerDiagonal = 1e-6;
  constexpr double kFloats = 4 * 0x1p-23;
  return std::max(kPerDiagonal * diagonal, kFloats * largest_coordinate);
}

}  // namespace algebra3d
