#include "rtree/detail/k_nearest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace rtree {
namespace {

// Distances whose squares underflow are smaller.
constexpr double kUnderflow = 0x1p-530;
// More than what is rounded in a distance or its square.
constexpr double kRounding = 1 + 0x1p-40;

// How much the distance of a box may be above that of its keys: on each axis as much as the coordinates of one key are
// apart, most where they are largest.
double resolution(const KeyFrame& frame, const KeyBox& bounds) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisFrame& map = frame.axes[axis];
    double widest = 0;
    for (const std::int32_t key : {bounds.min[axis], bounds.max[axis]})
      widest = std::max(widest, double_at(map.position(key, map.remainders())) - double_at(map.position(key, 0)));
    sum += widest;
  }
  return sum;
}

template <typename Payload>
class Search {
 public:
  Search(const TreeView<Payload>& tree, const Target& target, std::size_t k)
      : tree_(tree),
        target_(target),
        k_(k),
        resolution_(resolution(tree.frame, tree.node(tree.root, tree.height).bounds())) {
    found_.reserve(4 * kMostNearest);
  }

  std::vector<LeafSlot> run() {
    enter(tree_.root, tree_.height);
    while (depth_ > 0) {
      Frame& top = frames_[depth_ - 1];
      const std::size_t slot = nearest_slot(top);
      if (slot == kFanOut)
        --depth_;
      else
        enter(tree_.inner[top.node].reference[slot], top.level - 1);
    }
    std::vector<LeafSlot> result;
    for (const Found& found : found_)
      if (found.square <= bound_) result.push_back(found.place);
    return result;
  }

 private:
  struct Frame {
    NodeIndex node;
    std::uint32_t level;
    double squares[kFanOut];  // of children not yet visited; else infinite
  };
  struct Found {
    double square;
    LeafSlot place;
  };

  void enter(NodeIndex node, std::uint32_t level) {
    if (level == 0) return enter_leaf(node);
    Frame& frame = frames_[depth_++];
    frame.node = node;
    frame.level = level;
    scans_.squared_distances(tree_.inner[node], target_, tree_.frame, frame.squares);
    for (std::size_t slot = tree_.inner[node].count(); slot < kFanOut; ++slot) frame.squares[slot] = Box3::kInfinity;
  }

  // Takes the nearest child; kFanOut if all that are left are too far.
  std::size_t nearest_slot(Frame& frame) const {
    std::size_t best = 0;
    for (std::size_t slot = 1; slot < kFanOut; ++slot) best = frame.squares[slot] < frame.squares[best] ? slot : best;
    const double square = std::exchange(frame.squares[best], Box3::kInfinity);
    if (frame.level == 1) prefetch_nearest(frame);
    return square <= bound_ && square < Box3::kInfinity ? best : kFanOut;
  }

  // The leaf after the next one is on its way meanwhile.
  void prefetch_nearest(const Frame& frame) const {
    std::size_t best = 0;
    for (std::size_t slot = 1; slot < kFanOut; ++slot) best = frame.squares[slot] < frame.squares[best] ? slot : best;
    if (frame.squares[best] <= bound_) prefetch(tree_.leaves[tree_.inner[frame.node].reference[best]]);
  }

  void enter_leaf(NodeIndex index) {
    const Node<Payload>& leaf = tree_.leaves[index];
    double squares[kFanOut];
    scans_.squared_distances(leaf, target_, tree_.frame, squares);
    for (std::uint32_t slot = 0; slot < kFanOut && leaf.is_used(slot); ++slot) {
      if (squares[slot] > bound_) continue;
      found_.push_back({squares[slot], {index, slot}});
      lower_bound(squares[slot]);
    }
  }

  // The bound comes from the largest of the k nearest squares seen. These are of keys: exact distances may be larger by
  // the resolution and by what was rounded.
  void lower_bound(double square) {
    if (nearest_count_ == k_ && square >= nearest_[k_ - 1]) return;
    if (nearest_count_ < k_) ++nearest_count_;
    std::size_t place = nearest_count_ - 1;
    for (; place > 0 && nearest_[place - 1] > square; --place) nearest_[place] = nearest_[place - 1];
    nearest_[place] = square;
    if (nearest_count_ < k_) return;
    const double distance = (std::sqrt(nearest_[k_ - 1]) + resolution_ + kUnderflow) * kRounding;
    bound_ = distance * distance * kRounding + kUnderflow;
  }

  const NodeScans& scans_ = node_scans();
  const TreeView<Payload>& tree_;
  const Target& target_;
  std::size_t k_;
  double resolution_;
  double bound_ = Box3::kInfinity;  // on squares; farther entries are not among the nearest
  std::size_t nearest_count_ = 0;
  std::array<double, kMostNearest> nearest_;  // squares, ascending
  std::vector<Found> found_;
  std::uint32_t depth_ = 0;
  std::array<Frame, kMaxLevels> frames_;
};

}  // namespace

template <typename Payload>
std::vector<LeafSlot> k_nearest(const TreeView<Payload>& tree, const Target& target, std::size_t k) {
  return Search<Payload>(tree, target, k).run();
}

template std::vector<LeafSlot> k_nearest(const TreeView<std::uint32_t>&, const Target&, std::size_t);
template std::vector<LeafSlot> k_nearest(const TreeView<std::uint64_t>&, const Target&, std::size_t);

}  // namespace rtree
