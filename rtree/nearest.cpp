#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "rtree/detail/cursors.h"

namespace rtree {
namespace {

// Up to this limit a bound is kept, whose upkeep is logarithmic in the limit. Chosen, not measured.
constexpr std::size_t kLargestBoundedLimit = 64;

// Where the square lies outside of this range, the scaled one is computed instead.
constexpr double kSmallSquare = 0x1p-900;
constexpr double kLargeSquare = 0x1p1000;

double gap_on(const Box3& a, const Box3& b, std::size_t axis) {
  const double above = a.min[axis] - b.max[axis];
  const double below = b.min[axis] - a.max[axis];
  return above > 0 ? above : below > 0 ? below : 0;
}

// Scaled by a power of two, the squares neither overflow nor underflow, and the distance is the one that the plain
// formula would give if exponents had no limit: distances of nodes and of their entries stay in order.
double scaled_distance(const Box3& a, const Box3& b, double scale) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double gap = scale * gap_on(a, b, axis);
    sum += gap * gap;
  }
  return std::sqrt(sum) / scale;
}

// The same for large gaps: coordinates are scaled before they are subtracted, and the result stays scaled.
double scaled_large_distance(const Box3& a, const Box3& b, double scale) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double above = scale * a.min[axis] - scale * b.max[axis];
    const double below = scale * b.min[axis] - scale * a.max[axis];
    const double gap = above > 0 ? above : below > 0 ? below : 0;
    sum += gap * gap;
  }
  return std::sqrt(sum);
}

// Distances between boxes up to here are finite.
constexpr double kNoOverflow = 0x1p1020;
// No distance between finite boxes leaves the range of doubles when it is multiplied by this.
constexpr double kFarScale = 0x1p-4;

// What stands for a distance below 1 where those from 1 on are scaled: the negative numbers, in the same order. No
// digit is lost at either end.
double near_code(double distance) {
  return -std::bit_cast<double>(std::bit_cast<std::uint64_t>(1.0) - std::bit_cast<std::uint64_t>(distance));
}

double distance_of_far_code(double code) {
  if (code >= 0) return code / kFarScale;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(1.0) - std::bit_cast<std::uint64_t>(-code));
}

bool reaches_far(const Box3& box) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (box.min[axis] < -kNoOverflow || box.max[axis] > kNoOverflow) return true;
  return false;
}

}  // namespace

template <typename Payload>
NearestCursor<Payload>::NearestCursor(const Storage<Payload>& storage, const Box3& box, std::size_t limit)
    : storage_(&storage), box_(box), limit_(limit) {
  if (storage.root == kNoNode || box.is_empty() || limit == 0) return;
  if (limit <= kLargestBoundedLimit) {
    bounds_size_ = limit;
    bounds_.reserve(limit);
  }
  heap_.reserve(128);
  is_far_ = reaches_far(box) || reaches_far(storage.bounds(storage.root));
  expand(storage.root, static_cast<std::uint32_t>(storage.height()));
}

template <typename Payload>
std::optional<Neighbor<Payload>> NearestCursor<Payload>::next() {
  while (limit_ > 0 && !heap_.empty()) {
    const Candidate nearest = pop();
    if (nearest.level == 0) {
      --limit_;
      return Neighbor<Payload>{nearest.reference, is_far_ ? distance_of_far_code(nearest.distance) : nearest.distance};
    }
    // What is nearest now is most likely expanded next.
    if (!heap_.empty() && heap_.front().level == 1)
      prefetch(storage_->nodes[static_cast<NodeIndex>(heap_.front().reference)]);
    expand(static_cast<NodeIndex>(nearest.reference), nearest.level - 1);
  }
  return std::nullopt;
}

template <typename Payload>
void NearestCursor<Payload>::expand(NodeIndex node_index, std::uint32_t level) {
  const Node<Payload>& node = storage_->nodes[node_index];
  double squares[kFanOut];
  for (SlotMask slots = squared_distances(node, box_, squares); slots != 0;) {
    const std::size_t slot = take_slot(slots);
    const double square = squares[slot];
    if (square > square_bound_) continue;
    double distance = std::sqrt(square);
    if (square < kSmallSquare) distance = scaled_distance(node.box(slot), box_, 0x1p600);
    if (square > kLargeSquare) distance = scaled_large_distance(node.box(slot), box_, 0x1p-600) / 0x1p-600;
    if (is_far_) distance = far_code(node.box(slot), distance);
    if (distance > bound_) continue;
    push({distance, node.reference[slot], level});
    if (level == 0 && bounds_size_ > 0) lower_bound(distance);
  }
}

// A distance may be beyond the largest double, and is to be told from others that are.
template <typename Payload>
double NearestCursor<Payload>::far_code(const Box3& to, double distance) const {
  if (distance < 1) return near_code(distance);
  if (distance < kNoOverflow) return distance * kFarScale;
  return scaled_large_distance(to, box_, 0x1p-600) * (kFarScale * 0x1p600);
}

// The bound is the largest of the nearest distances seen, once there are as many as are asked for.
template <typename Payload>
void NearestCursor<Payload>::lower_bound(double distance) {
  if (bounds_.size() == bounds_size_) {
    if (distance >= bounds_.front()) return;
    std::ranges::pop_heap(bounds_);
    bounds_.pop_back();
  }
  bounds_.push_back(distance);
  std::ranges::push_heap(bounds_);
  if (bounds_.size() < bounds_size_) return;
  bound_ = bounds_.front();
  if (is_far_) return;
  // A little more than the square, whatever was rounded: it only spares the root.
  square_bound_ = std::max(bound_ * bound_, kSmallSquare) * (1 + 0x1p-48);
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
