#include "queries/streams/detail/space_partition.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace queries {

using algebra3d::Box3;
using algebra3d::Vec3;

namespace {

/// The middle of a box on an axis. Halves are added, since the sum of its ends may overflow.
double middle_of(const Box3& box, std::size_t axis) {
  return box.min[axis] / 2 + box.max[axis] / 2;
}

}  // namespace

SpacePartition::SpacePartition(std::vector<Box3> sample, std::size_t count) : planes_(std::bit_ceil(count) - 1) {
  halve(1, sample);
}

/// Across the axis along which the middles are spread most.
void SpacePartition::halve(std::size_t node, std::span<Box3> sample) {
  if (node > planes_.size()) return;
  Plane& plane = planes_[node - 1];
  Box3 middles;
  for (const Box3& box : sample) middles.extend(Vec3{middle_of(box, 0), middle_of(box, 1), middle_of(box, 2)});
  if (!sample.empty()) {
    const Vec3 extent = middles.max - middles.min;
    plane.axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  }
  const auto by_middle = [&](const Box3& box) { return middle_of(box, plane.axis); };
  const std::size_t half = sample.size() / 2;
  if (!sample.empty()) {
    std::ranges::nth_element(sample, sample.begin() + static_cast<std::ptrdiff_t>(half), {}, by_middle);
    plane.place = by_middle(sample[half]);
  }
  halve(2 * node, sample.first(half));
  halve(2 * node + 1, sample.subspan(half));
}

std::size_t SpacePartition::part_of(const Vec3& place) const {
  std::size_t node = 1;
  while (node <= planes_.size()) {
    const Plane& plane = planes_[node - 1];
    node = 2 * node + (place[plane.axis] < plane.place ? 0 : 1);
  }
  return node - planes_.size() - 1;
}

}  // namespace queries
