#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/base/box3.h"

namespace queries {

/// Space divided into parts by planes across the axes, each of which halves a part: a k-d tree. A place on a plane
/// belongs to the upper side, so each place lies in one part.
class SpacePartition {
 public:
  /// Into at least `count` parts, the next power of two, with equal shares of the middles of sample boxes as far as
  /// planes can give them. Cost: n log n.
  SpacePartition(std::vector<algebra3d::Box3> sample, std::size_t count);

  std::size_t count() const { return planes_.size() + 1; }
  std::size_t part_of(const algebra3d::Vec3& place) const;
  /// Calls visit(part) for each part that the box meets, ascending. Stops at the first error.
  template <typename Visit>
  auto for_each(const algebra3d::Box3& box, Visit visit) const {
    return for_each_below(1, box, visit);
  }

 private:
  struct Plane {
    std::size_t axis = 0;
    double place = 0;
  };

  void halve(std::size_t node, std::span<algebra3d::Box3> sample);
  template <typename Visit>
  auto for_each_below(std::size_t node, const algebra3d::Box3& box, Visit& visit) const -> decltype(visit(node)) {
    if (node > planes_.size()) return visit(node - planes_.size() - 1);
    const Plane& plane = planes_[node - 1];
    if (box.min[plane.axis] < plane.place)
      if (auto status = for_each_below(2 * node, box, visit); !status) return status;
    if (box.max[plane.axis] >= plane.place) return for_each_below(2 * node + 1, box, visit);
    return {};
  }

  std::vector<Plane> planes_;  // node i has the children 2 i and 2 i + 1, from 1 on
};

}  // namespace queries
