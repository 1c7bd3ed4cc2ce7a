#include <algorithm>
#include <cmath>

#include "rtree/cursors.h"

namespace rtree {
namespace {

// A power of two by which the largest distance between the boxes comes to about 1: then no square overflows, and only
// distances below 1e-154 of the largest underflow.
double scale_for(const Box3& a, const Box3& b) {
  double largest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Halved first, so that the difference of the largest numbers stays finite.
    const double width = std::max(a.max[axis] / 2 - b.min[axis] / 2, b.max[axis] / 2 - a.min[axis] / 2);
    if (std::isfinite(width)) largest = std::max(largest, width);
  }
  if (largest == 0) return 1;
  return std::ldexp(1.0, std::clamp(-std::ilogb(largest) - 1, -1022, 1022));
}

}  // namespace

template <typename Payload>
NearestCursor<Payload>::NearestCursor(const Storage<Payload>& storage, const Box3& box)
    : storage_(&storage), box_(box) {
  if (storage.root == kNoNode || box.is_empty()) return;
  scale_ = scale_for(storage.bounds(storage.root), box);
  heap_.reserve(256);
  expand(storage.root, static_cast<std::uint32_t>(storage.height()));
}

template <typename Payload>
std::optional<Neighbor<Payload>> NearestCursor<Payload>::next() {
  while (!heap_.empty()) {
    const Candidate nearest = pop();
    if (nearest.level == 0) return Neighbor<Payload>{nearest.reference, std::sqrt(nearest.squared_distance) / scale_};
    expand(static_cast<NodeIndex>(nearest.reference), nearest.level - 1);
  }
  return std::nullopt;
}

template <typename Payload>
void NearestCursor<Payload>::expand(NodeIndex index, std::uint32_t level) {
  const Node<Payload>& node = storage_->nodes[index];
  alignas(16) double distances[kFanOut];
  SlotMask slots = squared_distances(node, box_, scale_, distances);
  while (slots != 0) {
    const std::size_t slot = take_slot(slots);
    push({distances[slot], node.reference[slot], level});
  }
}

template <typename Payload>
void NearestCursor<Payload>::push(const Candidate& candidate) {
  heap_.push_back(candidate);
  std::push_heap(heap_.begin(), heap_.end(), [](const auto& a, const auto& b) { return a.is_after(b); });
}

template <typename Payload>
auto NearestCursor<Payload>::pop() -> Candidate {
  std::pop_heap(heap_.begin(), heap_.end(), [](const auto& a, const auto& b) { return a.is_after(b); });
  const Candidate nearest = heap_.back();
  heap_.pop_back();
  return nearest;
}

template class NearestCursor<std::uint32_t>;
template class NearestCursor<std::uint64_t>;

}  // namespace rtree
