#include <algorithm>
#include <array>
#include <cassert>
#include <optional>

#include "rtree/detail/split.h"
#include "rtree/detail/storage.h"

namespace rtree {
namespace {

struct Place {
  NodeIndex leaf;
  std::size_t slot;
};

// Slots whose boxes contain `box`.
template <typename Payload>
SlotMask slots_containing(const Node<Payload>& node, const Box3& box) {
  SlotMask result = 0;
  for (SlotMask slots = slots_meeting(node, box); slots != 0;) {
    const std::size_t slot = take_slot(slots);
    if (node.box(slot).contains(box)) result |= SlotMask{1} << slot;
  }
  return result;
}

template <typename Payload>
std::optional<Place> find(const Storage<Payload>& storage, const Entry<Payload>& entry) {
  std::vector<NodeIndex> stack;
  if (storage.root != kNoNode) stack.push_back(storage.root);
  while (!stack.empty()) {
    const NodeIndex index = stack.back();
    stack.pop_back();
    const Node<Payload>& node = storage.nodes[index];
    const bool is_leaf = storage.infos[index].level == 0;
    for (SlotMask slots = slots_containing(node, entry.box); slots != 0;) {
      const std::size_t slot = take_slot(slots);
      if (!is_leaf)
        stack.push_back(node.child(slot));
      else if (node.entry(slot) == entry)
        return Place{index, slot};
    }
  }
  return std::nullopt;
}

template <typename Payload>
void tighten_slot(Storage<Payload>& storage, NodeIndex node) {
  storage.nodes[storage.infos[node].parent].set_box(storage.slot_in_parent(node), storage.bounds(node));
}

// The sister that grows least by taking the node in; of equal ones that in the lowest slot.
template <typename Payload>
NodeIndex choose_sister(const Storage<Payload>& storage, NodeIndex node) {
  const NodeIndex parent = storage.infos[node].parent;
  const std::size_t own_slot = storage.slot_in_parent(node);
  const Box3 own = storage.bounds(node);
  const auto margin = [](const Box3& box) {
    return (box.max.x - box.min.x) + (box.max.y - box.min.y) + (box.max.z - box.min.z);
  };
  std::size_t best = kFanOut;
  double least_growth = 0;
  for (std::size_t slot = 0; slot < storage.infos[parent].count; ++slot) {
    if (slot == own_slot) continue;
    const Box3 box = storage.nodes[parent].box(slot);
    const double growth = margin(unite(box, own)) - margin(box);
    if (best < kFanOut && !(growth < least_growth)) continue;
    best = slot;
    least_growth = growth;
  }
  return storage.nodes[parent].child(best);
}

// Merges an underfull node with a sister ([guttman1984], section 3.3, names it as the alternative to reinsertion), or
// shares the entries out anew where one node cannot hold them. Local and bounded, whatever the tree looks like.
template <typename Payload>
void fill_up(Storage<Payload>& storage, NodeIndex node) {
  const NodeIndex sister = choose_sister(storage, node);
  std::array<Entry<Payload>, kMaxSplit> entries;
  std::size_t count = 0;
  for (const NodeIndex source : {sister, node})
    for (std::size_t slot = 0; slot < storage.infos[source].count; ++slot)
      entries[count++] = storage.nodes[source].entry(slot);
  const std::span<Entry<Payload>> all(entries.data(), count);
  const std::size_t kept = count <= kFanOut ? count : split<Payload>(all);
  storage.clear(sister);
  storage.clear(node);
  for (std::size_t i = 0; i < count; ++i) storage.append(i < kept ? sister : node, all[i]);
  tighten_slot(storage, sister);
  if (kept < count) return tighten_slot(storage, node);
  storage.remove_slot(storage.infos[node].parent, storage.slot_in_parent(node));
  storage.free_node(node);
}

// Shortens the tree while the root has a single child; an empty tree has no root.
template <typename Payload>
void shrink_root(Storage<Payload>& storage) {
  while (storage.infos[storage.root].count <= 1) {
    const NodeIndex old_root = storage.root;
    const NodeInfo info = storage.infos[old_root];
    if (info.level == 0 && info.count == 1) return;
    storage.root = info.level == 0 ? kNoNode : storage.nodes[old_root].child(0);
    storage.free_node(old_root);
    if (storage.root == kNoNode) return;
    storage.infos[storage.root].parent = kNoNode;
  }
}

}  // namespace

template <typename Payload>
bool erase(Storage<Payload>& storage, const Entry<Payload>& entry) {
  const auto place = find(storage, entry);
  if (!place) return false;
  storage.remove_slot(place->leaf, place->slot);
  --storage.entry_count;
  for (NodeIndex node = place->leaf; node != storage.root;) {
    const NodeIndex parent = storage.infos[node].parent;
    if (storage.infos[node].count < kMinFill)
      fill_up(storage, node);
    else
      tighten_slot(storage, node);
    node = parent;
  }
  shrink_root(storage);
  return true;
}

template bool erase(Storage<std::uint32_t>&, const Entry<std::uint32_t>&);
template bool erase(Storage<std::uint64_t>&, const Entry<std::uint64_t>&);

}  // namespace rtree
