#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/rounding/coordinate_grid.h"

namespace algebra3d {

/// A lattice of cells, which are boxes between neighbouring lines: per axis ascending numbers of a grid of coordinates.
class CellLattice {
 public:
  /// The number of a cell, or of a line, per axis.
  using Index = std::array<std::uint32_t, 3>;
  /// The cells from the first to the last one, per axis.
  struct Block {
    Index first, last;

    bool is_one_cell() const { return first == last; }
  };

  /// Lines at the multiples of an edge length, from the last one below the bounds to the first one above, and one at
  /// the largest number of the grid if the next multiple is beyond it. The edge is a multiple of the spacing of the
  /// grid. Lines that coincide in doubles become one.
  CellLattice(const Box3& bounds, double edge, const CoordinateGrid& grid);

  /// False if the bounds reach beyond the largest number of the grid.
  bool covers(const Box3& bounds) const;
  std::size_t cell_count(std::size_t axis) const { return lines_[axis].size() - 1; }
  double line(std::size_t axis, std::uint32_t index) const { return lines_[axis][index]; }
  Box3 box(const Block& block) const;
  /// The cells whose closed boxes meet the box, which lies within the bounds.
  Block cells_at(const Box3& box) const;
  /// The largest diagonal of a cell; rounded up.
  double diagonal() const;

 private:
  std::array<std::vector<double>, 3> lines_;
};

/// A cell in one number; ascending by z, then y, then x. Cells of one column along x have the same number without the
/// last kBits.
struct CellKey {
  static constexpr unsigned kBits = 21;

  static std::uint64_t of(const CellLattice::Index& cell) {
    return (std::uint64_t{cell[2]} << (2 * kBits)) | (std::uint64_t{cell[1]} << kBits) | cell[0];
  }
  static CellLattice::Index cell(std::uint64_t key) {
    constexpr std::uint64_t kMask = (1U << kBits) - 1;
    return {static_cast<std::uint32_t>(key & kMask), static_cast<std::uint32_t>((key >> kBits) & kMask),
            static_cast<std::uint32_t>(key >> (2 * kBits))};
  }
  static std::uint64_t column(std::uint64_t key) { return key >> kBits; }
};

}  // namespace algebra3d
