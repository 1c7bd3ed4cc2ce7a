#pragma once

#include <cstdint>
#include <string>

namespace algebra3d {

/// A grid of doubles to which coordinates are rounded.
class CoordinateGrid {
 public:
  static CoordinateGrid doubles() { return {Kind::doubles, 0}; }
  static CoordinateGrid floats() { return {Kind::floats, 0}; }
  /// The grid of k * step for all integers k, each rounded once to a double. step > 0 and finite.
  static CoordinateGrid multiples(double step) { return {Kind::multiples, step}; }

  /// True for floats and doubles, whose spacing is far below what the digits of a coordinate mean.
  bool is_floating() const { return kind_ != Kind::multiples; }

  /// The nearest number of the grid, or one that is farther away by at most one rounding error; infinite beyond the
  /// range of the numbers. A number of the grid comes back as it is.
  double nearest(double coordinate) const;

  /// The largest distance of neighbouring grid numbers from -size to size; size >= 0.
  double spacing_up_to(double size) const;

  /// The largest number of the grid.
  double largest() const;

 private:
  enum class Kind : std::uint8_t { doubles, floats, multiples };
  CoordinateGrid(Kind kind, double step) : kind_(kind), step_(step) {}

  Kind kind_;
  double step_;
};

/// Why nothing is rounded to a grid: the largest coordinate, or the next number of the grid, is beyond its largest
/// number.
std::string out_of_range_text(double largest_coordinate, const CoordinateGrid& grid);

}  // namespace algebra3d
