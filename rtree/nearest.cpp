#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "rtree/detail/cursors.h"

namespace rtree {
namespace {

// Where the square lies outside of this range, the scaled one is computed instead.
constexpr double kSmallSquare = 0x1p-900;
constexpr double kLargeSquare = 0x1p1000;

// Infinities that were subtracted from each other count as no gap.
double largest_gap(double above, double below) {
  const double gap = above > 0 ? above : 0;
  return below > gap ? below : gap;
}

double gap_on(const Box3& a, const Box3& b, std::size_t axis) {
  return largest_gap(a.min[axis] - b.max[axis], b.min[axis] - a.max[axis]);
}

// In the order of the scans of nodes, and as a vector, so that it takes no branches.
double square_of_distance(const Box3& a, const Box3& b) {
  using Axes = __attribute__((vector_size(4 * sizeof(double)))) double;
  const Axes above = {a.min.x - b.max.x, a.min.y - b.max.y, a.min.z - b.max.z, 0};
  const Axes below = {b.min.x - a.max.x, b.min.y - a.max.y, b.min.z - a.max.z, 0};
  const Axes positive = above > 0.0 ? above : Axes{};
  const Axes gap = below > positive ? below : positive;
  const Axes squares = gap * gap;
  return squares[0] + squares[1] + squares[2];
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

// The distance for large gaps: coordinates are scaled before they are subtracted, and the result stays scaled.
double scaled_large_distance(const Box3& a, const Box3& b, double scale) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double above = scale * a.min[axis] - scale * b.max[axis];
    const double below = scale * b.min[axis] - scale * a.max[axis];
    const double gap = largest_gap(above, below);
    sum += gap * gap;
  }
  return std::sqrt(sum);
}

// Distances between boxes up to here are finite.
constexpr double kNoOverflow = 0x1p1020;
// No distance between finite boxes leaves the range of doubles when it is multiplied by this.
constexpr double kFarScale = 0x1p-4;

// Stands for a distance below 1 where those from 1 on are scaled: the negative numbers, in the same order. No digit is
// lost at either end.
double near_code(double distance) {
  return -std::bit_cast<double>(std::bit_cast<std::uint64_t>(1.0) - std::bit_cast<std::uint64_t>(distance));
}

double distance_of_far_code(double code) {
  if (code >= 0) return code / kFarScale;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(1.0) - std::bit_cast<std::uint64_t>(-code));
}

bool reaches_beyond(double limit, const Box3& box) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (box.min[axis] < -limit || box.max[axis] > limit) return true;
  return false;
}

}  // namespace

template <typename Leaf>
BasicNearestCursor<Leaf>::BasicNearestCursor(const TreeView<Leaf>& tree, const Box3& box, std::size_t limit)
    : tree_(tree), target_(box, tree.frame), limit_(limit) {
  if (tree.empty() || box.is_empty() || limit == 0) return;
  const Box3 bounds = tree.frame.outer_box(scans_->bounds(tree.node(tree.root, tree.height))).box();
  if (limit <= kMostNearest && !reaches_beyond(kNoSquareOverflow, box) && !reaches_beyond(kNoSquareOverflow, bounds)) {
    find_all();
    return;
  }
  is_far_ = reaches_beyond(kNoOverflow, box) || reaches_beyond(kNoOverflow, bounds);
  push({0, tree.root, kNode + tree.height});
}

// The exact boxes may lie far apart, and are fetched together.
template <typename Leaf>
void BasicNearestCursor<Leaf>::find_all() {
  const std::vector<LeafSlot> places = k_nearest(tree_, target_, limit_);
  for (const LeafSlot& place : places) tree_.prefetch_exact_box(place.leaf, place.slot);
  heap_.reserve(places.size());
  // Nearly in order.
  for (std::size_t i = places.size(); i-- > 0;) heap_.push_back(measured(places[i]));
  const auto comes_before = [](const auto& a, const auto& b) { return a.is_after(b); };
  std::sort(heap_.begin(), heap_.end(), comes_before);
  is_sorted_ = true;
}

template <typename Leaf>
auto BasicNearestCursor<Leaf>::next() -> std::optional<Neighbor<Payload>> {
  while (limit_ > 0 && !heap_.empty()) {
    const Candidate nearest = is_sorted_ ? take_last() : pop();
    if (nearest.rank == kExact) {
      --limit_;
      return Neighbor<Payload>{static_cast<Payload>(nearest.reference),
                               is_far_ ? distance_of_far_code(nearest.distance) : nearest.distance};
    }
    if (nearest.rank == kEntry) {
      push(measured({static_cast<NodeIndex>(nearest.reference / kFanOut),
                     static_cast<std::uint32_t>(nearest.reference % kFanOut)}));
      continue;
    }
    // The nearest node now is most likely expanded next.
    if (!heap_.empty() && heap_.front().rank == kNode)
      prefetch(tree_.leaves[static_cast<NodeIndex>(heap_.front().reference)]);
    expand(static_cast<NodeIndex>(nearest.reference), nearest.rank - kNode);
  }
  return std::nullopt;
}

// The distances of nodes and of keys are lower bounds of those of entries: also as rounded, since all are computed
// alike.
template <typename Leaf>
void BasicNearestCursor<Leaf>::expand(NodeIndex index, std::uint32_t level) {
  const KeyBoxes& node = tree_.node(index, level);
  double squares[kFanOut];
  scans_->squared_distances(node, target_, tree_.frame, squares);
  for (std::size_t slot = 0; slot < kFanOut && node.is_used(slot); ++slot) {
    const double distance = distance_to(tree_.frame.outer_box(node.box(slot)).box(), squares[slot]);
    if (level == 0)
      push({distance, std::uint64_t{index} * kFanOut + slot, kEntry});
    else
      push({distance, tree_.inner_node(index, level).reference[slot], kNode + level - 1});
  }
}

// The entry at its exact distance.
template <typename Leaf>
auto BasicNearestCursor<Leaf>::measured(const LeafSlot& place) const -> Candidate {
  const Box3 box = tree_.exact_coordinates(place.leaf, place.slot);
  const double distance = distance_to(box, square_of_distance(box, target_.box));
  return {distance, tree_.leaves[place.leaf].reference[place.slot], kExact};
}

template <typename Leaf>
double BasicNearestCursor<Leaf>::distance_to(const Box3& box, double square) const {
  double distance = std::sqrt(square);
  if (square < kSmallSquare) distance = scaled_distance(box, target_.box, 0x1p600);
  if (square > kLargeSquare) distance = scaled_large_distance(box, target_.box, 0x1p-600) / 0x1p-600;
  return is_far_ ? far_code(box, distance) : distance;
}

// A distance may be beyond the largest double, and must be distinguished from others that are.
template <typename Leaf>
double BasicNearestCursor<Leaf>::far_code(const Box3& to, double distance) const {
  if (distance < 1) return near_code(distance);
  if (distance < kNoOverflow) return distance * kFarScale;
  return scaled_large_distance(to, target_.box, 0x1p-600) * (kFarScale * 0x1p600);
}

template <typename Leaf>
void BasicNearestCursor<Leaf>::push(const Candidate& candidate) {
  heap_.push_back(candidate);
  std::push_heap(heap_.begin(), heap_.end(), [](const auto& a, const auto& b) { return a.is_after(b); });
}

template <typename Leaf>
auto BasicNearestCursor<Leaf>::pop() -> Candidate {
  std::pop_heap(heap_.begin(), heap_.end(), [](const auto& a, const auto& b) { return a.is_after(b); });
  return take_last();
}

template <typename Leaf>
auto BasicNearestCursor<Leaf>::take_last() -> Candidate {
  const Candidate nearest = heap_.back();
  heap_.pop_back();
  return nearest;
}

template class BasicNearestCursor<IndexLeaf>;
template class BasicNearestCursor<ExactLeaf<std::uint32_t>>;
template class BasicNearestCursor<ExactLeaf<std::uint64_t>>;

}  // namespace rtree
