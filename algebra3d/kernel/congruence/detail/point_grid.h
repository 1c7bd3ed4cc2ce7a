#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/congruence/detail/hash_chains.h"

namespace algebra3d::detail {

/// Points in cells of a grid. Refers to the points, which must outlive it.
class PointGrid {
 public:
  /// An empty grid for some points, of which `insert` adds the one with a number. The coordinates divided by the size
  /// of a cell must be below 2^62.
  PointGrid(const std::vector<Vec3>& points, double cell) : points_(points), cell_(cell), chains_(points.size()) {}

  void insert(std::uint32_t number) {
    const auto [x, y, z] = cell_of(points_[number]);
    chains_.insert(hash_of(x, y, z), number);
  }
  void insert_all() {
    for (std::uint32_t number = 0; number < points_.size(); ++number) insert(number);
  }
  /// Calls visit(number) for all points in the grid within `reach` of a place, and for others beside it, some of them
  /// several times; until it returns false.
  template <typename Visit>
  void for_each_near(const Vec3& place, double reach, const Visit& visit) const {
    const Cell low = cell_of(place - Vec3{reach, reach, reach}), high = cell_of(place + Vec3{reach, reach, reach});
    bool goes_on = true;
    for (std::uint64_t x = low[0]; goes_on && x != high[0] + 1; ++x)
      for (std::uint64_t y = low[1]; goes_on && y != high[1] + 1; ++y)
        for (std::uint64_t z = low[2]; goes_on && z != high[2] + 1; ++z)
          chains_.for_each(hash_of(x, y, z), [&](std::uint32_t number) { return goes_on = visit(number); });
  }

 private:
  using Cell = std::array<std::uint64_t, 3>;  // negative numbers modulo 2^64

  Cell cell_of(const Vec3& p) const {
    const auto cell = [this](double x) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x / cell_)));
    };
    return {cell(p.x), cell(p.y), cell(p.z)};
  }

  const std::vector<Vec3>& points_;
  double cell_;
  HashChains chains_;
};

/// Two of some points that are nearest to each other.
struct ClosestPair {
  std::uint32_t first = 0, second = 0;
  double distance = 0;
};
/// A closest pair of at least two points. Cost: linear, since the points are taken in an arbitrary order, in which few
/// of them make a closer pair than those before them [golin1995].
ClosestPair closest_pair(const std::vector<Vec3>& points);

}  // namespace algebra3d::detail
