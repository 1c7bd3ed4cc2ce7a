#include "rtree/detail/k_nearest.h"

#include <algorithm>
#include <array>
#include <cmath>

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

// Children that are fetched as long as no entries are known.
constexpr int kFirstPrefetched = 4;

template <typename Leaf>
class Search {
 public:
  Search(const TreeView<Leaf>& tree, const Target& target, std::size_t k)
      : tree_(tree),
        target_(target),
        k_(k),
        resolution_(resolution(tree.frame, tree.node(tree.root, tree.height).bounds())) {
    found_.resize(4 * k + 2 * kFanOut);
    std::ranges::fill(nearest(), Box3::kInfinity);
  }

  std::vector<LeafSlot> run() {
    enter(tree_.root, tree_.height);
    while (depth_ > 0) {
      Frame& top = frames_[depth_ - 1];
      const double square = scans_.least(top.children);
      if (square > bound_ || square >= RankedSlots::kFarthest) {
        --depth_;
        continue;
      }
      const std::size_t slot = RankedSlots::slot(square);
      top.children.squares[slot] = RankedSlots::kFarthest;
      enter(top.node->reference[slot], top.level - 1);
    }
    std::vector<LeafSlot> result(found_count_);
    std::size_t count = 0;
    for (std::size_t i = 0; i < found_count_; ++i) {
      result[count] = found_[i].place;
      count += found_[i].square <= bound_;
    }
    result.resize(count);
    return result;
  }

 private:
  struct Frame {
    const InnerNode* node;
    std::uint32_t level;
    RankedSlots children;  // those that were visited are farthest
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
    const SlotMask near = scans_.rank(*frame.node, target_, tree_.frame, bound_, frame.children);
    if (level <= 2) prefetch_children(frame, near);
  }

  // What will most likely be entered is on its way meanwhile: the children within the bound; as long as there is none,
  // some of the nearest.
  void prefetch_children(const Frame& frame, SlotMask near) const {
    if (bound_ == Box3::kInfinity) {
      near = 0;
      RankedSlots children = frame.children;
      for (int i = 0; i < kFirstPrefetched; ++i) {
        const std::size_t slot = RankedSlots::slot(scans_.least(children));
        children.squares[slot] = RankedSlots::kFarthest;
        near |= SlotMask{1} << slot;
      }
    }
    while (near != 0) {
      const NodeIndex child = frame.node->reference[take_slot(near)];
      if (frame.level == 1)
        prefetch(tree_.leaves[child]);
      else
        prefetch(tree_.inner[child]);
    }
  }

  void enter_leaf(NodeIndex index) {
    RankedSlots slots;
    SlotMask near = scans_.rank(tree_.leaf(index), target_, tree_.frame, bound_, slots);
    if (near == 0) return;
    scans_.keep(slots, near, nearest());
    if (found_.size() < found_count_ + kFanOut) found_.resize(2 * found_.size());
    while (near != 0) {
      const auto slot = static_cast<std::uint32_t>(take_slot(near));
      found_[found_count_++] = {slots.squares[slot], {index, slot}};
    }
    if (nearest_[k_ - 1] < RankedSlots::kFarthest) lower_bound();
  }

  // At least the k smallest squares of entries.
  std::span<double> nearest() {
    constexpr std::size_t kGrain = RankedSlots::kListGrain;
    return std::span(nearest_).first((k_ + kGrain - 1) / kGrain * kGrain);
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
  double bound_ = Box3::kInfinity;            // on squares; farther entries are not among the nearest
  std::array<double, kMostNearest> nearest_;  // squares, ascending
  algebra3d::LargeVector<Found> found_;
  std::size_t found_count_ = 0;
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
