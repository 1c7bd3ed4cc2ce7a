#include "algebra3d/kernel/rounding/detail/lattice_squares.h"

#include <array>
#include <utility>

namespace algebra3d {

std::uint32_t LatticeSquares::vertex(const CellLattice::Index& lines) {
  const auto [entry, is_new] = vertices_.try_emplace(CellKey::of(lines), static_cast<std::uint32_t>(points_.size()));
  if (is_new) points_.push_back({lattice_.line(0, lines[0]), lattice_.line(1, lines[1]), lattice_.line(2, lines[2])});
  return entry->second;
}

void LatticeSquares::add(const CellLattice::Index& cell, std::size_t axis, bool is_upper) {
  // Counter-clockwise seen from above the axis.
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::array<std::uint32_t, 4> corners{};
  for (std::uint32_t i = 0; i < 4; ++i) {
    CellLattice::Index lines = cell;
    lines[axis] += is_upper ? 1 : 0;
    lines[u] += i == 1 || i == 2 ? 1 : 0;
    lines[v] += i >= 2 ? 1 : 0;
    corners[i] = vertex(lines);
  }
  if (!is_upper) std::swap(corners[1], corners[3]);
  triangles_.push_back({corners[0], corners[1], corners[2]});
  triangles_.push_back({corners[0], corners[2], corners[3]});
}

TriangleMesh LatticeSquares::mesh() && {
  return {PointArray(std::move(points_)), triangles_};
}

}  // namespace algebra3d
