#pragma once

#include "rtree/detail/storage.h"

namespace rtree {

/// The nodes of a tree with the keys of another frame, so that they can be compared with the nodes of a tree that has
/// it. The boxes of inner nodes contain those below, but need not be the least that do. For exact boxes ask the tree.
/// Cost: linear.
template <typename Leaf>
class Translation {
 public:
  Translation(const TreeView<Leaf>& tree, const KeyFrame& frame);

  TreeView<Leaf> view() const;

 private:
  KeyBox translated(NodeIndex leaf, std::size_t slot) const;

  TreeView<Leaf> tree_;
  KeyFrame frame_;
  LargeVector<InnerNode> inner_;
  LargeVector<Leaf> leaves_;
};

}  // namespace rtree
