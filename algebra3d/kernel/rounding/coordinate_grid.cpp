#include "algebra3d/kernel/rounding/coordinate_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/number_text.h"

namespace algebra3d {
namespace {

constexpr double kLargestFloat = std::numeric_limits<float>::max();
/// The least number that rounds to an infinite float: half of a spacing beyond the largest one.
constexpr double kEndOfFloats = 0x1.FFFFFFp127;

}  // namespace

double CoordinateGrid::spacing_up_to(double size) const {
  const int exponent = size > 0 ? std::ilogb(size) : 0;
  switch (kind_) {
    case Kind::doubles:
      return std::ldexp(1, std::max(exponent - 52, -1074));
    case Kind::floats:
      return std::ldexp(1, std::max(exponent - 23, -149));
    default:
      return step_;
  }
}

double CoordinateGrid::nearest(double coordinate) const {
  switch (kind_) {
    case Kind::doubles:
      return coordinate;
    case Kind::floats:
      // Beyond the range the cast would be undefined.
      if (std::abs(coordinate) >= kEndOfFloats)
        return std::copysign(std::numeric_limits<double>::infinity(), coordinate);
      if (std::abs(coordinate) > kLargestFloat) return std::copysign(kLargestFloat, coordinate);
      return static_cast<float>(coordinate);
    default: {
      // Far out the multiples are as dense as the doubles, or denser.
      constexpr double kFarOut = 4503599627370496;  // 2^52
      const double multiple = coordinate / step_;
      return std::abs(multiple) < kFarOut ? std::round(multiple) * step_ : coordinate;
    }
  }
}

double CoordinateGrid::largest() const {
  constexpr double kLargest = std::numeric_limits<double>::max();
  switch (kind_) {
    case Kind::doubles:
      return kLargest;
    case Kind::floats:
      return kLargestFloat;
    default: {
      const double number = nearest(kLargest);  // the next multiple below, if that is too large
      return std::isfinite(number) ? number : (std::round(kLargest / step_) - 1) * step_;
    }
  }
}

std::string out_of_range_text(double largest_coordinate, const CoordinateGrid& grid) {
  return fmt::format("a coordinate is out of range: {} is the largest one, and the numbers end at {}",
                     real_text(largest_coordinate), real_text(grid.largest()));
}

}  // namespace algebra3d
