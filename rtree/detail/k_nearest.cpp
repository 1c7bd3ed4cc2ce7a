#include "rtree/detail/k_nearest.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rtree {
namespace {

// Larger than each distance whose square underflows.
constexpr double kUnderflow = 0x1p-530;
// More than what is rounded in a distance or its square, or is missing where a square has numbers in its lowest bits.
constexpr double kRounding = 1 + 0x1p-38;

// By how much the distance of a box from the target may exceed the distance of its keys: on each axis by the width of
// one key, at the side of the box that faces the target.
class Resolution {
 public:
  Resolution(const KeyFrame& frame, const Box3& target) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // A key has 2^shift doubles, each less than 2^-52 of the next power of two from the one before.
      const auto share = std::bit_cast<double>((1023 - 51 + std::uint64_t{frame.axes[axis].shift}) << 52);
      at_target_ += share * std::max(std::abs(target.min[axis]), std::abs(target.max[axis]));
      for_distance_ += share;
    }
  }

  /// `distance`: of the keys from the target.
  double at(double distance) const { return at_target_ + for_distance_ * distance + kUnderflow; }

 private:
  double at_target_ = 0, for_distance_ = 0;
};

// Number of children that are prefetched as long as no entries are known.
constexpr std::size_t kFirstPrefetched = 4;

template <typename Leaf>
class Search {
 public:
  Search(const TreeView<Leaf>& tree, const Target& target, std::size_t k)
      : tree_(tree),
        target_(target),
        k_(k),
        list_size_((k + kSpare + NearestList::kGrain - 1) / NearestList::kGrain * NearestList::kGrain),
        resolution_(tree.frame, target.box) {
    std::fill_n(nearest_.squares, list_size_, Box3::kInfinity);
  }

  std::vector<LeafSlot> run() {
    enter(tree_.root, tree_.height);
    while (group_count_ > 0) visit_next(next_group());
    const bool is_complete = node_count_ <= NearestList::kMaxNodes && nearest_.squares[list_size_ - 1] > bound_;
    return is_complete ? listed() : collected();
  }

 private:
  // Places of the list beyond k, so that it also holds a few further entries at the same distance.
  static constexpr std::size_t kSpare = 2;
  static constexpr std::uint32_t kFewGroups = 16;

  // Children of a node that are to be visited.
  struct Group {
    RankedSlots children;
    const InnerNode* node;
    SlotMask slots;
    std::uint32_t level;
    double least;  // of their squares
  };

  void enter(NodeIndex node, std::uint32_t level) {
    if (level == 0) return enter_leaf(node);
    Group& group = groups_[group_count_];
    group.node = &tree_.inner_node(node, level);
    group.level = level;
    group.slots = scans_.rank(*group.node, target_, tree_.frame, bound_, group.children);
    if (group.slots == 0) return;
    if (level <= 2) prefetch_children(group);
    set_least(group_count_++);
  }

  // Inner nodes come before leaves at twice their distance: so that the content of these is fetched in time.
  void set_least(std::uint32_t index) {
    Group& group = groups_[index];
    group.least = scans_.least(group.children, group.slots);
    const auto bits = std::bit_cast<std::uint64_t>(group.least);
    constexpr std::uint64_t kQuarter = std::uint64_t{2} << 52;
    order_[index] = group.level > 1 ? std::max(bits, kQuarter) - kQuarter : bits;
  }

  std::uint32_t next_group() const {
    std::uint32_t next = 0;
    if (group_count_ < kFewGroups) {
      std::uint64_t least = order_[0];
      for (std::uint32_t i = 1; i < group_count_; ++i) {
        next = order_[i] < least ? i : next;
        least = order_[i] < least ? order_[i] : least;
      }
      return next;
    }
    // The group of the lowest level: until it is done at most `height` more are added.
    for (std::uint32_t i = 1; i < group_count_; ++i)
      if (groups_[i].level < groups_[next].level) next = i;
    return next;
  }

  void visit_next(std::uint32_t index) {
    Group& group = groups_[index];
    if (group.least > bound_) return drop(index);
    const std::size_t slot = RankedSlots::slot(group.least);
    const NodeIndex child = group.node->reference[slot];
    const std::uint32_t level = group.level - 1;
    group.slots &= ~(SlotMask{1} << slot);
    if (group.slots == 0)
      drop(index);
    else
      set_least(index);
    enter(child, level);
  }

  void drop(std::uint32_t index) {
    --group_count_;
    if (index == group_count_) return;
    groups_[index] = groups_[group_count_];
    order_[index] = order_[group_count_];
  }

  // Prefetches the children that are likely to be visited: those within the bound, or some of the nearest as long as
  // there is no bound.
  void prefetch_children(const Group& group) const {
    SlotMask near = group.slots;
    if (bound_ == Box3::kInfinity) near &= scans_.nearest(group.children, kFirstPrefetched);
    while (near != 0) {
      const NodeIndex child = group.node->reference[take_slot(near)];
      if (group.level == 1)
        prefetch(tree_.leaves[child]);
      else
        prefetch(tree_.inner[child]);
    }
  }

  void enter_leaf(NodeIndex index) {
    RankedSlots slots;
    const SlotMask near = scans_.rank(tree_.leaf(index), target_, tree_.frame, bound_, slots);
    if (near == 0) return;
    const std::uint32_t number = std::min(node_count_++, NearestList::kMaxNodes - 1);
    leaves_[number] = index;
    scans_.keep(slots, near, number, nearest_, list_size_);
    lower_bound();
  }

  // The bound comes from the largest of the k nearest squares seen. These are of keys: exact distances may be larger by
  // the resolution, and squares of exact distances accordingly.
  void lower_bound() {
    const double square = nearest_.squares[k_ - 1];
    if (square < square_of_slack_ / 4) {
      square_of_slack_ = square;
      const double distance = std::sqrt(square), resolution = resolution_.at(distance);
      slack_ = resolution * (2 * distance + resolution);
    }
    bound_ = (square + slack_) * kRounding;
  }

  std::vector<LeafSlot> listed() const {
    std::vector<LeafSlot> result;
    result.reserve(list_size_);
    for (std::size_t i = 0; i < list_size_ && nearest_.squares[i] <= bound_; ++i)
      result.push_back({leaves_[NearestList::node(nearest_.squares[i])],
                        static_cast<std::uint32_t>(RankedSlots::slot(nearest_.squares[i]))});
    return result;
  }

  // All within the bound, where these are too many for the list.
  std::vector<LeafSlot> collected() const {
    std::vector<LeafSlot> result;
    std::vector<std::pair<NodeIndex, std::uint32_t>> waiting{{tree_.root, tree_.height}};
    while (!waiting.empty()) {
      const auto [node, level] = waiting.back();
      waiting.pop_back();
      RankedSlots ranked;
      SlotMask near = scans_.rank(tree_.node(node, level), target_, tree_.frame, bound_, ranked);
      while (near != 0) {
        const auto slot = static_cast<std::uint32_t>(take_slot(near));
        if (level == 0)
          result.push_back({node, slot});
        else
          waiting.push_back({tree_.inner_node(node, level).reference[slot], level - 1});
      }
    }
    return result;
  }

  NearestList nearest_;
  Group groups_[kFewGroups + kMaxLevels];
  std::uint64_t order_[kFewGroups + kMaxLevels];
  std::uint32_t group_count_ = 0;
  std::uint32_t node_count_ = 0;
  NodeIndex leaves_[NearestList::kMaxNodes];
  const NodeScans& scans_ = node_scans();
  const TreeView<Leaf>& tree_;
  const Target& target_;
  std::size_t k_;
  std::size_t list_size_;
  Resolution resolution_;
  double square_of_slack_ = Box3::kInfinity;  // for which the slack was found
  double slack_ = Box3::kInfinity;            // not less than for the squares that are bounds now
  double bound_ = Box3::kInfinity;            // on squares; farther entries are not among the nearest
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
