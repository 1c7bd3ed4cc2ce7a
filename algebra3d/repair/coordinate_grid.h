#pragma once

#include <cstdint>

namespace algebra3d {

/// The numbers to which coordinates are rounded. All are doubles.
class CoordinateGrid {
 public:
  static CoordinateGrid doubles() { return {Kind::doubles, 0}; }
  static CoordinateGrid floats() { return {Kind::floats, 0}; }
  /// k * step for all integers k, each rounded once to a double. step > 0 and finite.
  static CoordinateGrid multiples(double step) { return {Kind::multiples, step}; }

  /// The nearest such number, up to an error of one rounding; infinite if that is beyond the range of the numbers.
  /// A number of the grid is given back as it is.
  double nearest(double coordinate) const;

  /// The largest distance of neighbouring numbers among those up to `size` >= 0, and down to -size.
  double spacing_up_to(double size) const;

 private:
  enum class Kind : std::uint8_t { doubles, floats, multiples };
  CoordinateGrid(Kind kind, double step) : kind_(kind), step_(step) {}

  Kind kind_;
  double step_;
};

}  // namespace algebra3d
