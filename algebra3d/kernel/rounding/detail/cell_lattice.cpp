#include "algebra3d/kernel/rounding/detail/cell_lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra3d/kernel/rounding/detail/rounded_vertices.h"

namespace algebra3d {
namespace {

void push_if_above(std::vector<double>& lines, double line) {
  if (std::isfinite(line) && (lines.empty() || line > lines.back())) lines.push_back(line);
}
void push_if_below(std::vector<double>& lines, double line) {
  if (std::isfinite(line) && (lines.empty() || line < lines.front())) lines.insert(lines.begin(), line);
}

std::vector<double> lines_over(double low, double high, double edge, const CoordinateGrid& grid) {
  std::vector<double> lines;
  // One more on each side: the quotients and the products are rounded.
  const double last = std::ceil(high / edge) + 1;
  for (double k = std::floor(low / edge) - 1; k <= last; ++k) push_if_above(lines, grid.nearest(k * edge));
  for (const double limit : {double{std::numeric_limits<float>::max()}, std::numeric_limits<double>::max()}) {
    if (lines.empty() || lines.back() < high) push_if_above(lines, grid.nearest(limit));
    if (lines.front() > low) push_if_below(lines, grid.nearest(-limit));
  }
  // From the last line at or below the lower side to the first one at or above the upper side, or the next one: a flat
  // mesh may lie upon a line.
  std::ptrdiff_t first = std::ranges::upper_bound(lines, low) - lines.begin() - 1;
  std::ptrdiff_t end_line = std::ranges::lower_bound(lines, high) - lines.begin();
  first = std::max<std::ptrdiff_t>(first, 0);
  end_line = std::min(std::max(end_line, first + 1), std::ssize(lines) - 1);
  if (end_line == first && first > 0) --first;
  return {lines.begin() + first, lines.begin() + end_line + 1};
}

}  // namespace

CellLattice::CellLattice(const Box3& bounds, double edge, const CoordinateGrid& grid) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    lines_[axis] = lines_over(bounds.min[axis], bounds.max[axis], edge, grid);
}

bool CellLattice::covers(const Box3& bounds) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double>& lines = lines_[axis];
    if (lines.size() < 2 || lines.front() > bounds.min[axis] || lines.back() < bounds.max[axis]) return false;
  }
  return true;
}

Box3 CellLattice::box(const Block& block) const {
  const auto corner = [&](const Index& cell, std::uint32_t shift) {
    return Vec3{lines_[0][cell[0] + shift], lines_[1][cell[1] + shift], lines_[2][cell[2] + shift]};
  };
  return {corner(block.first, 0), corner(block.last, 1)};
}

CellLattice::Block CellLattice::cells_at(const Box3& box) const {
  Block block{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // The first line at or above the lower side ends the first cell; the last line at or below the upper side begins
    // the last one.
    const std::vector<double>& lines = lines_[axis];
    const auto first = std::ranges::lower_bound(lines, box.min[axis]) - lines.begin() - 1;
    const auto last = std::ranges::upper_bound(lines, box.max[axis]) - lines.begin() - 1;
    block.first[axis] = static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(first, 0));
    block.last[axis] = static_cast<std::uint32_t>(std::min<std::ptrdiff_t>(last, std::ssize(lines) - 2));
  }
  return block;
}

double CellLattice::diagonal() const {
  Vec3 longest;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i + 1 < lines_[axis].size(); ++i)
      longest[axis] = std::max(longest[axis], lines_[axis][i + 1] - lines_[axis][i]);
  return rounded_up(std::hypot(longest.x, longest.y, longest.z));
}

}  // namespace algebra3d
