#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "algebra3d/base/box3.h"

namespace bench {

// The usual rival of a tree in a join: both sets in the cells of a grid over y and z, a sweep along x in each cell. A
// pair is reported in the cell of the least corner of what is common.
class GridSweep {
 public:
  using Box3 = algebra3d::Box3;

  GridSweep(const std::vector<Box3>& first, const std::vector<Box3>& second) : first_(first), second_(second) {
    double widest = 0;
    for (const auto* boxes : {&first, &second}) {
      for (const Box3& box : *boxes) {
        bounds_.extend(box);
        widest = std::max({widest, box.max.y - box.min.y, box.max.z - box.min.z});
      }
    }
    const double extent = std::max(bounds_.max.y - bounds_.min.y, bounds_.max.z - bounds_.min.z);
    const double most = std::sqrt(static_cast<double>(first.size() + second.size()) / 8);
    side_ = std::max(1.0, std::min(most, extent / (2 * widest)));
    scale_ = side_ / (extent * (1 + 0x1p-20));
    side_ = std::ceil(side_);
  }

  template <typename Visit>
  void run(const Visit& visit) {
    const auto a = cells_of(first_), b = cells_of(second_);
    const auto cell_count = static_cast<std::size_t>(side_ * side_);
    for (std::size_t cell = 0; cell < cell_count; ++cell) {
      const std::uint32_t *i = a.items.data() + a.begins[cell], *i_end = a.items.data() + a.begins[cell + 1];
      const std::uint32_t *j = b.items.data() + b.begins[cell], *j_end = b.items.data() + b.begins[cell + 1];
      while (i != i_end && j != j_end) {
        if (first_[*i].min.x <= second_[*j].min.x) {
          for (const auto* k = j; k != j_end && second_[*k].min.x <= first_[*i].max.x; ++k) report(*i, *k, cell, visit);
          ++i;
        } else {
          for (const auto* k = i; k != i_end && first_[*k].min.x <= second_[*j].max.x; ++k) report(*k, *j, cell, visit);
          ++j;
        }
      }
    }
  }

 private:
  struct Cells {
    std::vector<std::uint32_t> begins, items;
  };

  std::size_t row(double y) const { return static_cast<std::size_t>((y - bounds_.min.y) * scale_); }
  std::size_t column(double z) const { return static_cast<std::size_t>((z - bounds_.min.z) * scale_); }
  std::size_t cell(std::size_t row, std::size_t column) const { return row * static_cast<std::size_t>(side_) + column; }

  template <typename Visit>
  void for_each_cell(const Box3& box, const Visit& visit) const {
    for (std::size_t r = row(box.min.y); r <= row(box.max.y); ++r)
      for (std::size_t c = column(box.min.z); c <= column(box.max.z); ++c) visit(cell(r, c));
  }

  // The boxes of each cell in the order of their least x: sorted once, then dealt out.
  Cells cells_of(const std::vector<Box3>& boxes) const {
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::size_t i = 0; i < boxes.size(); ++i) order.emplace_back(boxes[i].min.x, static_cast<std::uint32_t>(i));
    std::sort(order.begin(), order.end());
    Cells cells;
    cells.begins.resize(static_cast<std::size_t>(side_ * side_) + 2);
    for (const Box3& box : boxes) for_each_cell(box, [&](std::size_t cell) { ++cells.begins[cell + 2]; });
    for (std::size_t i = 1; i < cells.begins.size(); ++i) cells.begins[i] += cells.begins[i - 1];
    cells.items.resize(cells.begins.back());
    for (const auto& [x, i] : order)
      for_each_cell(boxes[i], [&, item = i](std::size_t cell) { cells.items[cells.begins[cell + 1]++] = item; });
    return cells;
  }

  template <typename Visit>
  void report(std::uint32_t i, std::uint32_t j, std::size_t here, const Visit& visit) const {
    const Box3 &a = first_[i], &b = second_[j];
    if (a.min.y > b.max.y || b.min.y > a.max.y || a.min.z > b.max.z || b.min.z > a.max.z) return;
    if (cell(row(std::max(a.min.y, b.min.y)), column(std::max(a.min.z, b.min.z))) == here) visit(i, j);
  }

  const std::vector<Box3>& first_;
  const std::vector<Box3>& second_;
  Box3 bounds_;
  double side_;  // cells on an axis
  double scale_;
};

template <typename Visit>
void grid_sweep_join(const std::vector<algebra3d::Box3>& first, const std::vector<algebra3d::Box3>& second,
                     const Visit& visit) {
  GridSweep(first, second).run(visit);
}

}  // namespace bench
