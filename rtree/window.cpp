#include "rtree/detail/cursors.h"

namespace rtree {

template <typename Payload>
WindowCursor<Payload>::WindowCursor(const Storage<Payload>& storage, const Box3& window)
    : nodes_(storage.nodes.data()), window_(window) {
  if (storage.root == kNoNode || window.is_empty()) return;
  enter(nodes_[storage.root], static_cast<std::uint32_t>(storage.height()));
}

template <typename Payload>
void WindowCursor<Payload>::enter(const Node<Payload>& node, std::uint32_t level) {
  const SlotMask slots = slots_meeting(node, window_);
  if (level == 0) {
    leaf_ = &node;
    leaf_slots_ = slots;
    return;
  }
  if (slots == 0) return;
  frames_[depth_++] = {&node, slots, level};
  if (level == 1) prefetch_leaves(node, slots);
}

// All leaves at once, so that their cache misses overlap: in a tree larger than the cache they are what a query costs.
template <typename Payload>
void WindowCursor<Payload>::prefetch_leaves(const Node<Payload>& node, SlotMask slots) const {
  while (slots != 0) prefetch(nodes_[node.child(take_slot(slots))]);
}

template <typename Payload>
bool WindowCursor<Payload>::find_leaf() {
  while (leaf_slots_ == 0 && depth_ > 0) {
    Frame& top = frames_[depth_ - 1];
    const Node<Payload>& child = nodes_[top.node->child(take_slot(top.slots))];
    const std::uint32_t level = top.level - 1;
    if (top.slots == 0) --depth_;
    enter(child, level);
  }
  return leaf_slots_ != 0;
}

template class WindowCursor<std::uint32_t>;
template class WindowCursor<std::uint64_t>;

}  // namespace rtree
