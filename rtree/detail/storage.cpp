#include "rtree/detail/storage.h"

#include <algorithm>

namespace rtree {

template <typename Payload>
Box3 TreeView<Payload>::bounds() const {
  if (empty()) return {};
  const KeyBox keys = node(root, height).bounds();
  OrderedBox result{{INT64_MAX, INT64_MAX, INT64_MAX}, {INT64_MIN, INT64_MIN, INT64_MIN}};
  struct Step {
    NodeIndex node;
    std::uint32_t level;
  };
  std::vector<Step> steps{{root, height}};
  while (!steps.empty()) {
    const auto [index, level] = steps.back();
    steps.pop_back();
    const KeyBoxes& slots = node(index, level);
    for (std::size_t slot = 0; slot < kFanOut && slots.is_used(slot); ++slot) {
      const KeyBox box = slots.box(slot);
      bool is_extreme = false;
      for (std::size_t axis = 0; axis < 3; ++axis)
        is_extreme |= (box.min[axis] == keys.min[axis]) | (box.max[axis] == keys.max[axis]);
      if (!is_extreme) continue;
      if (level == 0)
        result.extend(exact_box(index, slot));
      else
        steps.push_back({inner[index].reference[slot], level - 1});
    }
  }
  return result.box();
}

template <typename Payload>
std::size_t Storage<Payload>::heap_bytes() const {
  return inner.capacity() * sizeof(InnerNode) + leaves.capacity() * sizeof(Node<Payload>) +
         remainders.capacity() * sizeof(Remainders) +
         (free_inner.capacity() + free_leaves.capacity()) * sizeof(NodeIndex);
}

template <typename Payload>
NodeIndex Storage<Payload>::add_node(std::uint32_t level) {
  std::vector<NodeIndex>& free_nodes = level == 0 ? free_leaves : free_inner;
  NodeIndex node;
  if (!free_nodes.empty()) {
    node = free_nodes.back();
    free_nodes.pop_back();
  } else if (level > 0) {
    node = static_cast<NodeIndex>(inner.size());
    inner.emplace_back();
  } else {
    node = static_cast<NodeIndex>(leaves.size());
    leaves.emplace_back();
    remainders.emplace_back();
  }
  clear(node, level);
  return node;
}

template <typename Payload>
void Storage<Payload>::free_node(NodeIndex node, std::uint32_t level) {
  clear(node, level);
  (level == 0 ? free_leaves : free_inner).push_back(node);
}

template <typename Payload>
void Storage<Payload>::clear(NodeIndex node, std::uint32_t level) {
  this->node(node, level).clear();
  if (level > 0) {
    std::ranges::fill(inner[node].reference, 0);
    return;
  }
  std::ranges::fill(leaves[node].reference, 0);
  remainders[node].clear();
}

template <typename Payload>
SlotContent<Payload> Storage<Payload>::content(NodeIndex node, std::uint32_t level, std::size_t slot) const {
  if (level > 0) return {frame.outer_box(inner[node].box(slot)), Payload{inner[node].reference[slot]}};
  return {view().exact_box(node, slot), leaves[node].reference[slot]};
}

template <typename Payload>
void Storage<Payload>::set(NodeIndex node, std::uint32_t level, std::size_t slot, const SlotContent<Payload>& content) {
  this->node(node, level).set_box(slot, frame.keys_in_range(content.box));
  if (level > 0) {
    inner[node].reference[slot] = static_cast<NodeIndex>(content.reference);
    return;
  }
  leaves[node].reference[slot] = content.reference;
  remainders[node].set(slot, content.box, frame);
}

template <typename Payload>
void Storage<Payload>::remove_slot(NodeIndex node, std::uint32_t level, std::size_t slot) {
  KeyBoxes& boxes = this->node(node, level);
  const std::size_t last = boxes.count() - 1;
  set(node, level, slot, content(node, level, last));
  boxes.clear(last);
  if (level > 0) {
    inner[node].reference[last] = 0;
    return;
  }
  leaves[node].reference[last] = 0;
  remainders[node].set(last, {}, frame);
}

template <typename Payload>
void Storage<Payload>::widen_frame(const OrderedBox& box) {
  const KeyFrame old = frame;
  frame = old.widened(box);
  for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
    for (std::size_t slot = 0; slot < kFanOut && leaves[leaf].is_used(slot); ++slot) {
      const OrderedBox exact = exact_box(old, leaves[leaf], remainders[leaf], slot);
      leaves[leaf].set_box(slot, frame.keys_in_range(exact));
      remainders[leaf].set(slot, exact, frame);
    }
  }
  // Rounding to wider keys keeps unions.
  for (InnerNode& node : inner)
    for (std::size_t slot = 0; slot < kFanOut && node.is_used(slot); ++slot)
      node.set_box(slot, frame.keys_in_range(old.outer_box(node.box(slot))));
}

template struct TreeView<std::uint32_t>;
template struct TreeView<std::uint64_t>;
template struct Storage<std::uint32_t>;
template struct Storage<std::uint64_t>;

}  // namespace rtree
