#include <algorithm>
#include <array>
#include <cassert>

#include "rtree/detail/box_size.h"
#include "rtree/detail/split.h"
#include "rtree/detail/storage.h"

namespace rtree {
namespace {

// Slots whose growth of overlap is computed. [beckmann1990] takes 32 of larger nodes; four was chosen, not measured.
constexpr std::ptrdiff_t kTried = 4;

// What it costs to put a box into a slot, in the order in which costs are compared.
struct Cost {
  double overlap = 0;
  double growth = 0;
  double margin_growth = 0;  // tells flat boxes apart, whose volumes are all 0
  double volume = 0;
  std::size_t slot = 0;

  auto operator<=>(const Cost&) const = default;
};

template <typename Payload>
Cost cost_of(const Node<Payload>& node, std::size_t slot, const Box3& added) {
  const Box3 box = node.box(slot);
  const Box3 grown = unite(box, added);
  return {0, volume(grown) - volume(box), margin(grown) - margin(box), volume(box), slot};
}

// The volume that `box` shares with the other slots.
template <typename Payload>
double shared_volume(const Node<Payload>& node, std::size_t count, std::size_t slot, const Box3& box) {
  double sum = 0;
  for (std::size_t other = 0; other < count; ++other) {
    double common = other != slot;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = std::max(box.min[axis], node.min[axis][other]);
      const double high = std::min(box.max[axis], node.max[axis][other]);
      common *= std::max(high - low, 0.0);
    }
    sum += common;
  }
  return sum;
}

// [beckmann1990], section 4.1: above the leaves the least growth of overlap, elsewhere the least growth of volume. The
// overlap is computed for the kTried slots that grow least.
template <typename Payload>
std::size_t choose_slot(const Storage<Payload>& storage, NodeIndex index, const Box3& added) {
  const Node<Payload>& node = storage.nodes[index];
  const NodeInfo info = storage.infos[index];
  std::array<Cost, kFanOut> costs;
  for (std::size_t slot = 0; slot < info.count; ++slot) costs[slot] = cost_of(node, slot, added);
  const auto is_cheaper = [](const Cost& a, const Cost& b) { return a < b; };
  auto* const first = costs.data();
  auto* const last = first + info.count;
  if (info.level > 1) return std::min_element(first, last, is_cheaper)->slot;
  auto* const tried = first + std::min<std::ptrdiff_t>(kTried, info.count);
  std::partial_sort(first, tried, last, is_cheaper);
  if (first->growth == 0 && first->margin_growth == 0) return first->slot;
  for (auto* cost = first; cost != tried; ++cost) {
    const Box3 box = node.box(cost->slot);
    cost->overlap = shared_volume(node, info.count, cost->slot, unite(box, added)) -
                    shared_volume(node, info.count, cost->slot, box);
  }
  return std::min_element(first, tried, is_cheaper)->slot;
}

// Puts `entry` into the full `node` and hands half of it to a new sister, which is returned as an entry for the parent.
template <typename Payload>
Entry<Payload> split_node(Storage<Payload>& storage, NodeIndex node, const Entry<Payload>& entry) {
  std::array<Entry<Payload>, kFanOut + 1> entries;
  for (std::size_t slot = 0; slot < kFanOut; ++slot) entries[slot] = storage.nodes[node].entry(slot);
  entries[kFanOut] = entry;
  const std::size_t kept = split<Payload>(entries);
  const NodeIndex sister = storage.add_node(storage.infos[node].level);
  storage.clear(node);
  for (std::size_t i = 0; i < entries.size(); ++i) storage.append(i < kept ? node : sister, entries[i]);
  return {storage.bounds(sister), Payload{sister}};
}

template <typename Payload>
void add_root(Storage<Payload>& storage, const Entry<Payload>& sister) {
  const NodeIndex old_root = storage.root;
  storage.root = storage.add_node(storage.infos[old_root].level + std::size_t{1});
  storage.append(storage.root, {storage.bounds(old_root), Payload{old_root}});
  storage.append(storage.root, sister);
}

// Grows the boxes above `node` by `added`.
template <typename Payload>
void grow_ancestors(Storage<Payload>& storage, NodeIndex node, const Box3& added) {
  while (node != storage.root) {
    const NodeIndex parent = storage.infos[node].parent;
    const std::size_t slot = storage.slot_in_parent(node);
    const Box3 box = storage.nodes[parent].box(slot);
    if (box.contains(added)) return;
    storage.nodes[parent].set_box(slot, unite(box, added));
    node = parent;
  }
}

}  // namespace

template <typename Payload>
void insert(Storage<Payload>& storage, const Entry<Payload>& entry) {
  ++storage.entry_count;
  if (storage.root == kNoNode) storage.root = storage.add_node(0);
  NodeIndex node = storage.root;
  while (storage.infos[node].level > 0) node = storage.nodes[node].child(choose_slot(storage, node, entry.box));

  Entry<Payload> pending = entry;
  while (storage.infos[node].count == kFanOut) {
    pending = split_node(storage, node, pending);
    if (node == storage.root) return add_root(storage, pending);
    const NodeIndex parent = storage.infos[node].parent;
    storage.nodes[parent].set_box(storage.slot_in_parent(node), storage.bounds(node));
    node = parent;
  }
  storage.append(node, pending);
  grow_ancestors(storage, node, entry.box);
}

template void insert(Storage<std::uint32_t>&, const Entry<std::uint32_t>&);
template void insert(Storage<std::uint64_t>&, const Entry<std::uint64_t>&);

}  // namespace rtree
