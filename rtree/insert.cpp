#include <algorithm>
#include <array>
#include <optional>

#include "rtree/detail/box_size.h"
#include "rtree/detail/node_scan.h"
#include "rtree/detail/redistribution.h"
#include "rtree/detail/storage.h"

namespace rtree {
namespace {

// The cost of putting a box into a slot, in the order in which costs are compared.
struct Cost {
  double overlap = 0;
  double growth = 0;
  double margin_growth = 0;  // distinguishes flat boxes, whose volumes are all 0
  double volume = 0;
  std::size_t slot = 0;

  auto operator<=>(const Cost&) const = default;
};

// The boxes of a node's slots, as doubles.
struct NodeBoxes {
  std::size_t count;
  std::array<Box3, kFanOut> boxes;

  NodeBoxes(const KeyBoxes& node, const KeyFrame& frame) : count(node.count()) {
    for (std::size_t slot = 0; slot < count; ++slot) boxes[slot] = frame.outer_box(node.box(slot)).box();
  }
};

Cost cost_of(const Box3& box, std::size_t slot, const Box3& added) {
  const Box3 grown = unite(box, added);
  return {0, volume(grown) - volume(box), margin(grown) - margin(box), volume(box), slot};
}

// The volume that `box` shares with the other slots.
double shared_volume(const NodeBoxes& node, std::size_t slot, const Box3& box) {
  double sum = 0;
  for (std::size_t other = 0; other < node.count; ++other) {
    double common = other != slot;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = std::max(box.min[axis], node.boxes[other].min[axis]);
      const double high = std::min(box.max[axis], node.boxes[other].max[axis]);
      common *= std::max(high - low, 0.0);
    }
    sum += common;
  }
  return sum;
}

// The least growth of overlap, then of volume: [beckmann1990], section 4.1, on all levels and for all slots.
std::size_t choose_slot(const NodeBoxes& node, const Box3& added) {
  std::array<Cost, kFanOut> costs;
  for (std::size_t slot = 0; slot < node.count; ++slot) costs[slot] = cost_of(node.boxes[slot], slot, added);
  const auto is_cheaper = [](const Cost& a, const Cost& b) { return a < b; };
  auto* const first = costs.data();
  auto* const last = first + node.count;
  const auto* const least = std::min_element(first, last, is_cheaper);
  if (least->growth == 0 && least->margin_growth == 0) return least->slot;
  for (auto* cost = first; cost != last; ++cost) {
    const Box3& box = node.boxes[cost->slot];
    cost->overlap = shared_volume(node, cost->slot, unite(box, added)) - shared_volume(node, cost->slot, box);
  }
  return std::min_element(first, last, is_cheaper)->slot;
}

template <typename Payload>
Path choose_path(const Storage<ExactLeaf<Payload>>& storage, const Box3& added) {
  Path path;
  NodeIndex node = storage.root;
  for (std::uint32_t level = storage.height; level > 0; --level) {
    const std::size_t slot = choose_slot(NodeBoxes(storage.inner_node(node, level), storage.frame), added);
    path[level - 1] = {node, slot};
    node = storage.inner[node].reference[slot];
  }
  return path;
}

// Looks for the leaf whose box meets the added one and grows least, in all parts of the tree: where boxes overlap, a
// way that decides at each node for itself often ends at leaves that have to grow much.
template <typename Payload>
class LeafChoice {
 public:
  LeafChoice(const Storage<ExactLeaf<Payload>>& storage, const Box3& added)
      : storage_(storage), added_(added), keys_(storage.frame.keys_in_range(OrderedBox::of(added))) {}

  /// The way to it; none if the box meets no leaf.
  std::optional<Path> choose() {
    if (storage_.height == 0) return std::nullopt;
    std::vector<Step> steps{{{}, storage_.root, storage_.height}};
    for (std::size_t visited = 0; !steps.empty() && visited < kMostVisited && least_cost_ > 0; ++visited) {
      const Step step = steps.back();
      steps.pop_back();
      const InnerNode& node = storage_.inner_node(step.node, step.level);
      for (SlotMask slots = node_scans().meeting(node, keys_); slots != 0;) {
        const std::size_t slot = take_slot(slots);
        Path path = step.path;
        path[step.level - 1] = {step.node, slot};
        if (step.level > 1)
          steps.push_back({path, node.reference[slot], step.level - 1});
        else
          judge(path, node, slot);
      }
    }
    return best_;
  }

 private:
  // More nodes than this are visited only where so many boxes overlap that the choice matters little.
  static constexpr std::size_t kMostVisited = 64;
  // The growth of the surface when a cube is halved.
  static constexpr double kSplitCost = 0.26;

  struct Step {
    Path path;
    NodeIndex node;
    std::uint32_t level;
  };

  // By surface, as the cost of a search is estimated by [goldsmith1987].
  void judge(const Path& path, const InnerNode& node, std::size_t slot) {
    const Box3 box = storage_.frame.outer_box(node.box(slot)).box();
    double cost = surface(unite(box, added_)) - surface(box);
    if (!(cost < least_cost_)) return;
    if (storage_.leaf(node.reference[slot]).is_used(kFanOut - 1)) cost += kSplitCost * surface(box);
    if (!(cost < least_cost_)) return;
    least_cost_ = cost;
    best_ = path;
  }

  const Storage<ExactLeaf<Payload>>& storage_;
  Box3 added_;
  KeyBox keys_;
  double least_cost_ = Box3::kInfinity;
  std::optional<Path> best_;
};

// Puts the content into the full `node` and hands half of it to a new sister, which is returned for the parent.
template <typename Payload>
SlotContent<Payload> split_node(Storage<ExactLeaf<Payload>>& storage, NodeIndex node, std::uint32_t level,
                                const SlotContent<Payload>& added) {
  Redistribution<Payload> redistribution;
  redistribution.take(storage, node, level);
  redistribution.take(added);
  const NodeIndex sister = storage.add_node(level);
  redistribution.distribute(storage, node, sister, level);
  return child_content(storage, sister, level);
}

template <typename Payload>
void add_root(Storage<ExactLeaf<Payload>>& storage, const SlotContent<Payload>& sister) {
  const SlotContent<Payload> old_root = child_content(storage, storage.root, storage.height);
  storage.root = storage.add_node(++storage.height);
  storage.set(storage.root, storage.height, 0, old_root);
  storage.set(storage.root, storage.height, 1, sister);
}

// Grows the boxes above a node of `level` by `added`.
template <typename Payload>
void grow_ancestors(Storage<ExactLeaf<Payload>>& storage, const Path& path, std::uint32_t level,
                    const OrderedBox& added) {
  const KeyBox keys = storage.frame.keys_in_range(added);
  for (; level < storage.height; ++level) {
    KeyBox box = storage.inner[path[level].node].box(path[level].slot);
    box.extend(keys);
    storage.set_child_box(path[level], box);
  }
}

}  // namespace

template <typename Payload>
void insert(Storage<ExactLeaf<Payload>>& storage, const Entry<Payload>& entry) {
  SlotContent<Payload> pending{OrderedBox::of(entry.box), entry.payload};
  if (storage.empty()) {
    storage = {};
    storage.root = storage.add_node(0);
  }
  if (!storage.frame.has(pending.box)) storage.widen_frame(pending.box);
  ++storage.entry_count;
  const std::optional<Path> chosen = LeafChoice<Payload>(storage, entry.box).choose();
  const Path path = chosen ? *chosen : choose_path(storage, entry.box);
  NodeIndex node = storage.height == 0 ? storage.root : storage.inner[path[0].node].reference[path[0].slot];
  std::uint32_t level = 0;
  while (storage.node(node, level).count() == kFanOut) {
    pending = split_node(storage, node, level, pending);
    if (level == storage.height) return add_root(storage, pending);
    const PathStep parent = path[level];
    storage.set_child_box(parent, storage.node(node, level).bounds());
    node = parent.node;
    ++level;
  }
  storage.set(node, level, storage.node(node, level).count(), pending);
  grow_ancestors(storage, path, level, OrderedBox::of(entry.box));
}

template void insert(Storage<ExactLeaf<std::uint32_t>>&, const Entry<std::uint32_t>&);
template void insert(Storage<ExactLeaf<std::uint64_t>>&, const Entry<std::uint64_t>&);

}  // namespace rtree
