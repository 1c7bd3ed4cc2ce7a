#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "base/hilbert.h"
#include "base/radix_sort.h"
#include "base/scheduler.h"
#include "rtree/detail/storage.h"

namespace rtree {

/// Number of bits of each coordinate of a cell.
inline constexpr std::uint32_t kCellBits = 10;
/// Number of cells on an axis.
inline constexpr std::uint32_t kCellsOnAxis = 1U << kCellBits;

/// An entry during bulk loading: where it lies on the curve, and its index in the input.
struct Place {
  std::uint32_t code;  ///< of 3 * kCellBits bits
  std::uint32_t index;
};

/// A grid of cubes over a region, with kCellsOnAxis of them on its longest axis.
class CellGrid {
 public:
  explicit CellGrid(const Box3& region) {
    double longest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      origin_[axis] = finite(region.min[axis]) / 4;
      longest = std::max(longest, finite(region.max[axis]) / 4 - origin_[axis]);
    }
    scale_ = 0.5 * kCellsOnAxis / longest;
  }

  /// False if the region is a point, or next to one.
  bool divides() const { return scale_ < std::numeric_limits<double>::infinity(); }
  /// The place on the curve of the cell that has the centre of a box; of the nearest cell if it is outside.
  std::uint32_t code(const Box3& box) const {
    return static_cast<std::uint32_t>(algebra3d::hilbert_code<kCellBits>(cell(box, 0), cell(box, 1), cell(box, 2)));
  }

 private:
  static double finite(double x) {
    constexpr double kLargest = std::numeric_limits<double>::max();
    return std::clamp(x, -kLargest, kLargest);
  }
  // Quarters, so that no sum and no difference is infinite unless the box is. A centre that is not a number is in cell
  // 0.
  std::uint32_t cell(const Box3& box, std::size_t axis) const {
    const double doubled = box.min[axis] / 4 + box.max[axis] / 4 - 2 * origin_[axis];
    const double number = doubled * scale_;
    const double positive = number > 0 ? number : 0;
    return static_cast<std::uint32_t>(positive < kCellsOnAxis - 1 ? positive : kCellsOnAxis - 1);
  }

  Vec3 origin_;   // a quarter of the least corner
  double scale_;  // from twice the distances of quarters to cells
};

/// Sorts places along Hilbert's curve. Those in one cell are sorted again in a finer grid until no cell has more than
/// fill a node. Equal centres stay in the order of their indices. `box_at` gives the box of an index.
template <typename BoxAt>
class SpatialSorter {
 public:
  SpatialSorter(std::span<Place> places, const BoxAt& box_at)
      : places_(places), buffer_(places.size()), box_at_(box_at) {}

  /// `places` has the indices in ascending order, and codes of one grid.
  void sort() {
    Spans crowded;
    sort({0, places_.size()}, crowded);
    algebra3d::parallel_for(crowded.size(), 64, [&](std::size_t i) { refine(crowded[i]); });
  }

 private:
  using Span = std::pair<std::size_t, std::size_t>;
  using Spans = std::vector<Span>;

  // Adds the cells with too many places to `crowded`.
  void sort(Span span, Spans& crowded) {
    const std::size_t count = span.second - span.first;
    algebra3d::radix_sort<3 * kCellBits>(places_.subspan(span.first, count),
                                         std::span<Place>(buffer_).subspan(span.first, count),
                                         [](const Place& place) { return place.code; });
    for (std::size_t i = span.first; i + kFanOut < span.second;) {
      // Sorted codes: a cell is crowded if the place that is a node further has the same.
      if (places_[i].code != places_[i + kFanOut].code) {
        ++i;
        continue;
      }
      std::size_t end = i + kFanOut + 1;
      while (end < span.second && places_[end].code == places_[i].code) ++end;
      crowded.push_back({i, end});
      i = end;
    }
  }

  void refine(Span span) {
    Spans crowded{span};
    while (!crowded.empty()) {
      const Span next = crowded.back();
      crowded.pop_back();
      const CellGrid grid(centers(next));
      if (!grid.divides()) continue;
      for (std::size_t i = next.first; i < next.second; ++i) places_[i].code = grid.code(box_at_(places_[i].index));
      sort(next, crowded);
    }
  }

  Box3 centers(Span span) const {
    Box3 result;
    for (std::size_t i = span.first; i < span.second; ++i) {
      const Box3& box = box_at_(places_[i].index);
      const Vec3 center = 0.5 * box.min + 0.5 * box.max;
      // Not where an extent is infinite on both sides.
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (center[axis] < result.min[axis]) result.min[axis] = center[axis];
        if (center[axis] > result.max[axis]) result.max[axis] = center[axis];
      }
    }
    return result;
  }

  std::span<Place> places_;
  LargeVector<Place> buffer_;
  const BoxAt& box_at_;
};

}  // namespace rtree
