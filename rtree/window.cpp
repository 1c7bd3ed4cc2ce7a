#include "rtree/detail/cursors.h"

namespace rtree {

template <typename Leaf>
BasicWindowCursor<Leaf>::BasicWindowCursor(const TreeView<Leaf>& tree, const Box3& window)
    : tree_(tree), window_(window, tree.frame) {
  if (tree.empty() || window.is_empty()) return;
  enter(tree.root, tree.height);
}

template <typename Leaf>
void BasicWindowCursor<Leaf>::enter(NodeIndex node, std::uint32_t level) {
  if (level == 0) return enter_leaf(node);
  const InnerNode& inner = tree_.inner_node(node, level);
  SlotMask slots = scans_->meeting(inner, window_.keys);
  if (slots == 0) return;
  frames_[depth_++] = {&inner, slots, level};
  // All leaves at once, so that their cache misses overlap: in a tree larger than the cache they are what a query
  // costs.
  if (level == 1)
    while (slots != 0) prefetch(tree_.leaves[inner.reference[take_slot(slots)]]);
}

template <typename Leaf>
void BasicWindowCursor<Leaf>::enter_leaf(NodeIndex leaf) {
  leaf_ = &tree_.leaf(leaf);
  const Meeting meeting = scans_->meeting_exactly(*leaf_, window_.keys);
  leaf_slots_ = meeting.slots();
  for (SlotMask open = meeting.open(); open != 0;) {
    const std::size_t slot = take_slot(open);
    if (!tree_.exact_box(leaf, slot).intersects(window_.exact)) leaf_slots_ &= ~(SlotMask{1} << slot);
  }
}

template <typename Leaf>
bool BasicWindowCursor<Leaf>::find_leaf() {
  while (leaf_slots_ == 0 && depth_ > 0) {
    Frame& top = frames_[depth_ - 1];
    const NodeIndex child = top.node->reference[take_slot(top.slots)];
    const std::uint32_t level = top.level - 1;
    if (top.slots == 0) --depth_;
    enter(child, level);
  }
  return leaf_slots_ != 0;
}

template class BasicWindowCursor<IndexLeaf>;
template class BasicWindowCursor<ExactLeaf<std::uint32_t>>;
template class BasicWindowCursor<ExactLeaf<std::uint64_t>>;

}  // namespace rtree
