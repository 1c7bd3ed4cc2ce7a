#include "rtree/detail/translation.h"

#include "base/scheduler.h"

namespace rtree {
namespace {

constexpr std::size_t kNodeGrain = 256;

}  // namespace

template <typename Leaf>
Translation<Leaf>::Translation(const TreeView<Leaf>& tree, const KeyFrame& frame)
    : tree_(tree), frame_(frame), inner_(tree.inner_count), leaves_(tree.leaf_count) {
  if constexpr (kHasRemainders<Leaf>) {
    if (tree_.unread != nullptr) tree_.unread->need_all();
    tree_.unread = nullptr;
  }
  algebra3d::parallel_for(leaves_.size(), kNodeGrain, [&](std::size_t leaf) {
    leaves_[leaf] = tree.leaves[leaf];
    for (std::size_t slot = 0; slot < kFanOut && leaves_[leaf].is_used(slot); ++slot)
      leaves_[leaf].set_box(slot, translated(static_cast<NodeIndex>(leaf), slot));
  });
  algebra3d::parallel_for(inner_.size(), kNodeGrain, [&](std::size_t node) {
    inner_[node] = tree.inner[node];
    for (std::size_t slot = 0; slot < kFanOut && inner_[node].is_used(slot); ++slot)
      inner_[node].set_box(slot, frame.keys(tree.frame.outer_box(inner_[node].box(slot))));
  });
}

// Mostly the key determines the other one; the exact box of an entry may have to be fetched from far away.
template <typename Leaf>
KeyBox Translation<Leaf>::translated(NodeIndex leaf, std::size_t slot) const {
  const KeyBox keys = tree_.leaves[leaf].box(slot);
  KeyBox least, greatest;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisFrame &from = tree_.frame.axes[axis], &to = frame_.axes[axis];
    least.min[axis] = to.key(from.position(keys.min[axis], 0));
    least.max[axis] = to.key(from.position(keys.max[axis], 0));
    greatest.min[axis] = to.key(from.position(keys.min[axis], from.remainders()));
    greatest.max[axis] = to.key(from.position(keys.max[axis], from.remainders()));
  }
  return least == greatest ? least : frame_.keys(tree_.exact_box(leaf, slot));
}

template <typename Leaf>
TreeView<Leaf> Translation<Leaf>::view() const {
  TreeView<Leaf> result = tree_;
  result.inner = inner_.data();
  result.leaves = leaves_.data();
  result.unread = nullptr;
  result.boxes = nullptr;
  result.frame = frame_;
  return result;
}

template class Translation<IndexLeaf>;
template class Translation<ExactLeaf<std::uint32_t>>;
template class Translation<ExactLeaf<std::uint64_t>>;

}  // namespace rtree
