#pragma once

#include "rtree/detail/storage.h"

namespace rtree {

/// The nodes of a tree with the keys of another frame, so that they can be compared with the nodes of a tree that has
/// it. The boxes of inner nodes contain those below, but need not be the least that do. Without remainders. Cost:
/// linear.
template <typename Payload>
class Translation {
 public:
  Translation(const TreeView<Payload>& tree, const KeyFrame& frame);

  TreeView<Payload> view() const;

 private:
  KeyBox translated(NodeIndex leaf, std::size_t slot) const;

  TreeView<Payload> tree_;
  KeyFrame frame_;
  LargeVector<InnerNode> inner_;
  LargeVector<Node<Payload>> leaves_;
};

}  // namespace rtree
