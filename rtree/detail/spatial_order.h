#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "algebra3d/base/scheduler.h"
#include "rtree/detail/hilbert.h"
#include "rtree/detail/radix_sort.h"

namespace rtree {

/// Half of the centre of a box. Infinite extents are cut off, so that it is finite, and so is the difference of two.
inline Vec3 half_center(const Box3& box) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  Vec3 result;
  for (std::size_t axis = 0; axis < 3; ++axis)
    result[axis] =
        std::clamp(box.min[axis], -kLargest, kLargest) / 4 + std::clamp(box.max[axis], -kLargest, kLargest) / 4;
  return result;
}

/// A grid of cubes over a region, with kCellsOnAxis of them on its longest axis.
class CellGrid {
 public:
  explicit CellGrid(const Box3& region) : origin_(region.min) {
    double longest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) longest = std::max(longest, region.max[axis] - region.min[axis]);
    scale_ = kCellsOnAxis / longest;
  }

  /// False if the region is a point, or next to one.
  bool divides() const { return scale_ < std::numeric_limits<double>::infinity(); }
  /// The place on the curve of the cell that has this point of the region.
  std::uint32_t code(const Vec3& point) const { return hilbert_code(cell(point, 0), cell(point, 1), cell(point, 2)); }

 private:
  std::uint32_t cell(const Vec3& point, std::size_t axis) const {
    const auto number = static_cast<std::int32_t>((point[axis] - origin_[axis]) * scale_);
    return static_cast<std::uint32_t>(std::min(number, static_cast<std::int32_t>(kCellsOnAxis - 1)));
  }

  Vec3 origin_;
  double scale_;
};

/// Sorts places along Hilbert's curve. Those in one cell are sorted again in a finer grid until no cell has more than
/// fill a node. Equal centres stay in the order of their indices. `center` gives the half centre of an index.
template <typename Center>
class SpatialSorter {
 public:
  SpatialSorter(std::span<Place> places, const Center& center)
      : places_(places), buffer_(places.size()), center_(center) {}

  /// `places` has the indices in ascending order, whose centres lie in `region`.
  void sort(const Box3& region) {
    Spans crowded;
    sort({0, places_.size()}, region, crowded);
    algebra3d::parallel_for(crowded.size(), 64, [&](std::size_t i) { refine(crowded[i]); });
  }

 private:
  using Span = std::pair<std::size_t, std::size_t>;
  using Spans = std::vector<Span>;
  static constexpr std::size_t kGrain = std::size_t{1} << 14;

  // Adds the cells with too many places to `crowded`.
  void sort(Span span, const Box3& region, Spans& crowded) {
    const CellGrid grid(region);
    if (!grid.divides()) return;
    const auto places = places_.subspan(span.first, span.second - span.first);
    algebra3d::parallel_for(places.size(), kGrain,
                            [&](std::size_t i) { places[i].code = grid.code(center_(places[i].index)); });
    radix_sort(places, std::span<Place>(buffer_).subspan(span.first, places.size()));
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
      Box3 region;
      for (std::size_t i = next.first; i < next.second; ++i) region.extend(center_(places_[i].index));
      sort(next, region, crowded);
    }
  }

  std::span<Place> places_;
  LargeVector<Place> buffer_;
  const Center& center_;
};

}  // namespace rtree
