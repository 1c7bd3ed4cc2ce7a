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

template <typename Leaf>
class Search {
 public:
  Search(const TreeView<Leaf>& tree, const Target& target, std::size_t k)
      : tree_(tree),
        target_(target),
        k_(k),
        resolution_(resolution(tree.frame, tree.node(tree.root, tree.height).bounds())) {
    found_.reserve(4 * k);
  }

  std::vector<LeafSlot> run() {
    enter(tree_.root, tree_.height);
    while (depth_ > 0) {
      Frame& top = frames_[depth_ - 1];
      const std::size_t slot = nearest_slot(top);
      if (slot == kFanOut)
        --depth_;
      else
        enter(top.node->reference[slot], top.level - 1);
    }
    std::vector<LeafSlot> result;
    result.reserve(found_.size());
    for (const Found& found : found_)
      if (found.square <= bound_) result.push_back(found.place);
    return result;
  }

 private:
  struct Frame {
    const InnerNode* node;
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
    frame.node = &tree_.inner[node];
    frame.level = level;
    scans_.squared_distances(tree_.inner[node], target_, tree_.frame, frame.squares);
    for (std::size_t slot = tree_.inner[node].count(); slot < kFanOut; ++slot) frame.squares[slot] = Box3::kInfinity;
  }

  // Takes the nearest child; kFanOut if all that are left are too far.
  std::size_t nearest_slot(Frame& frame) const {
    const std::size_t best = smallest(frame.squares);
    const double square = std::exchange(frame.squares[best], Box3::kInfinity);
    if (square > bound_ || square == Box3::kInfinity) return kFanOut;
    // The leaf after this one is on its way meanwhile.
    if (frame.level == 1) {
      const std::size_t after = smallest(frame.squares);
      if (frame.squares[after] <= bound_) prefetch(tree_.leaves[frame.node->reference[after]]);
    }
    return best;
  }

  // Four chains of comparisons that do not wait for each other.
  static std::size_t smallest(const double (&squares)[kFanOut]) {
    std::size_t best[4] = {0, 1, 2, 3};
    for (std::size_t first = 4; first < kFanOut; first += 4)
      for (std::size_t lane = 0; lane < 4; ++lane)
        best[lane] = squares[first + lane] < squares[best[lane]] ? first + lane : best[lane];
    const std::size_t low = squares[best[1]] < squares[best[0]] ? best[1] : best[0];
    const std::size_t high = squares[best[3]] < squares[best[2]] ? best[3] : best[2];
    return squares[high] < squares[low] ? high : low;
  }

  void enter_leaf(NodeIndex index) {
    const Leaf& leaf = tree_.leaf(index);
    double squares[kFanOut];
    scans_.squared_distances(leaf, target_, tree_.frame, squares);
    SlotMask near = 0;
    for (std::size_t slot = 0; slot < kFanOut; ++slot)
      near |= static_cast<SlotMask>((squares[slot] <= bound_) & leaf.is_used(slot)) << slot;
    while (near != 0) {
      const auto slot = static_cast<std::uint32_t>(take_slot(near));
      found_.push_back({squares[slot], {index, slot}});
      keep(squares[slot]);
    }
    if (nearest_count_ == k_) lower_bound();
  }

  // Keeps the square if it is one of the k smallest.
  void keep(double square) {
    if (nearest_count_ == k_ && square >= nearest_[k_ - 1]) return;
    if (nearest_count_ < k_) ++nearest_count_;
    std::size_t place = nearest_count_ - 1;
    for (; place > 0 && nearest_[place - 1] > square; --place) nearest_[place] = nearest_[place - 1];
    nearest_[place] = square;
  }

  // The bound comes from the largest of the k nearest squares seen. These are of keys: exact distances may be larger by
  // the resolution and by what was rounded.
  void lower_bound() {
    const double distance = (std::sqrt(nearest_[k_ - 1]) + resolution_ + kUnderflow) * kRounding;
    bound_ = distance * distance * kRounding + kUnderflow;
  }

  const NodeScans& scans_ = node_scans();
  const TreeView<Leaf>& tree_;
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

template <typename Leaf>
std::vector<LeafSlot> k_nearest(const TreeView<Leaf>& tree, const Target& target, std::size_t k) {
  return Search<Leaf>(tree, target, k).run();
}

template std::vector<LeafSlot> k_nearest(const TreeView<IndexLeaf>&, const Target&, std::size_t);
template std::vector<LeafSlot> k_nearest(const TreeView<ExactLeaf<std::uint32_t>>&, const Target&, std::size_t);
template std::vector<LeafSlot> k_nearest(const TreeView<ExactLeaf<std::uint64_t>>&, const Target&, std::size_t);

}  // namespace rtree
