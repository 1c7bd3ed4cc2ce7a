#pragma once

#include <array>
#include <span>
#include <vector>

#include "rtree/detail/key_frame.h"
#include "rtree/detail/node_set.h"
#include "rtree/detail/unread_nodes.h"

namespace rtree {

/// A tree as cursors see it: arrays of nodes that name each other by index, wherever they lie.
template <typename Leaf>
struct TreeView {
  using Payload = typename Leaf::Payload;

  const InnerNode* inner = nullptr;
  const Leaf* leaves = nullptr;
  UnreadNodes<Leaf>* unread = nullptr;  ///< null if all nodes have been read
  std::size_t inner_count = 0, leaf_count = 0;
  const Box3* boxes = nullptr;  ///< by payload, if the leaves have no remainders
  KeyFrame frame;
  NodeIndex root = 0;  ///< a leaf if the height is 0, else an inner node
  std::uint32_t height = 0;
  std::size_t entry_count = 0;

  bool empty() const { return entry_count == 0; }
  /// A node at its level in the tree, which is read if it was not. Errors: those of UnreadNodes.
  const Leaf& leaf(NodeIndex index) const {
    need(index, 0);
    return leaves[index];
  }
  const InnerNode& inner_node(NodeIndex index, std::uint32_t level) const {
    need(index, level);
    return inner[index];
  }
  const KeyBoxes& node(NodeIndex index, std::uint32_t level) const {
    return level == 0 ? static_cast<const KeyBoxes&>(leaf(index)) : inner_node(index, level);
  }
  /// Domain: a leaf that has been read.
  OrderedBox exact_box(NodeIndex leaf, std::size_t slot) const {
    if constexpr (kHasRemainders<Leaf>)
      return rtree::exact_box(frame, leaves[leaf], leaves[leaf].remainders, slot);
    else
      return OrderedBox::of(boxes[leaves[leaf].reference[slot]]);
  }
  /// The exact box of an entry as doubles.
  Box3 exact_coordinates(NodeIndex leaf, std::size_t slot) const {
    if constexpr (kHasRemainders<Leaf>)
      return exact_box(leaf, slot).box();
    else
      return boxes[leaves[leaf].reference[slot]];
  }
  void prefetch_exact_box(NodeIndex leaf, std::size_t slot) const {
    if constexpr (kHasRemainders<Leaf>) {
      prefetch_bytes(&leaves[leaf].remainders, sizeof(Remainders));
    } else {
      prefetch_bytes(boxes + leaves[leaf].reference[slot], sizeof(Box3));
    }
  }
  /// Smallest box around all entries. Cost: that of finding the entries whose keys are those of the whole tree.
  Box3 bounds() const;

 private:
  void need(NodeIndex index, std::uint32_t level) const {
    if constexpr (kHasRemainders<Leaf>)
      if (unread != nullptr) unread->need(index, level);
  }
};

/// The content of a slot: the box of an entry with its payload, or that of a child with its index.
template <typename Payload>
struct SlotContent {
  OrderedBox box;
  Payload reference;
};

/// A slot of an inner node on the way from the root to a leaf. The node has been read.
struct PathStep {
  NodeIndex node;
  std::size_t slot;
};
/// The way to a leaf: the step from level L + 1 to level L at position L.
using Path = std::array<PathStep, kMaxLevels>;

/// The nodes of a tree in flat arrays. Invariants (those that `audit` checks): all leaves have the same depth; the box
/// of a child's slot is the union of the child's boxes; every node but the root has at least kMinFill used slots, an
/// inner root two; every node is either reachable from the root exactly once or free. Free nodes are clear, and linked
/// by their first reference. Nodes of an image are read when they are asked for by `leaf`, `inner_node` or `node`.
template <typename Leaf>
struct Storage {
  using Payload = typename Leaf::Payload;

  UnreadPart<Leaf> unread;
  LargeVector<InnerNode> inner;
  LargeVector<Leaf> leaves;
  NodeIndex free_inner = kNoNode, free_leaf = kNoNode;  ///< the first ones
  NodeSet changed_inner, changed_leaves;                ///< since the state was last stored
  KeyFrame frame;
  NodeIndex root = 0;
  std::uint32_t height = 0;
  std::size_t entry_count = 0;

  bool empty() const { return entry_count == 0; }
  TreeView<Leaf> view(const Box3* boxes = nullptr) const {
    return {inner.data(), leaves.data(), unread.get(), inner.size(), leaves.size(),
            boxes,        frame,         root,         height,       entry_count};
  }
  const Leaf& leaf(NodeIndex index) const {
    need(index, 0);
    return leaves[index];
  }
  Leaf& leaf(NodeIndex index) {
    need(index, 0);
    return leaves[index];
  }
  const InnerNode& inner_node(NodeIndex index, std::uint32_t level) const {
    need(index, level);
    return inner[index];
  }
  InnerNode& inner_node(NodeIndex index, std::uint32_t level) {
    need(index, level);
    return inner[index];
  }
  const KeyBoxes& node(NodeIndex index, std::uint32_t level) const {
    return level == 0 ? static_cast<const KeyBoxes&>(leaf(index)) : inner_node(index, level);
  }
  std::size_t heap_bytes() const { return inner.capacity() * sizeof(InnerNode) + leaves.capacity() * sizeof(Leaf); }

  /// Adds an empty node.
  NodeIndex add_node(std::uint32_t level);
  /// Frees a node that has been removed from its parent.
  void free_node(NodeIndex node, std::uint32_t level);
  /// Empties a node.
  void clear(NodeIndex node, std::uint32_t level);
  /// The content of a slot, and its box as exact as it is stored; for a child the largest box with its keys.
  SlotContent<Payload> content(NodeIndex node, std::uint32_t level, std::size_t slot) const;
  /// Sets a slot; the box is in the range of the frame.
  void set(NodeIndex node, std::uint32_t level, std::size_t slot, const SlotContent<Payload>& content);
  /// Sets the box of a child.
  void set_child_box(const PathStep& place, const KeyBox& box);
  /// Removes a slot; the last used slot moves to its position.
  void remove_slot(NodeIndex node, std::uint32_t level, std::size_t slot);
  /// Changes the keys of all nodes to a frame whose range has `box` besides. Cost: linear; the range at least doubles.
  void widen_frame(const OrderedBox& box);

 private:
  void need(NodeIndex node, std::uint32_t level) const {
    if constexpr (kHasRemainders<Leaf>)
      if (auto* const nodes = unread.get()) nodes->need(node, level);
  }
  void mark(NodeIndex node, std::uint32_t level) { (level == 0 ? changed_leaves : changed_inner).insert(node); }
  void add_to_arrays(std::uint32_t level);
  NodeIndex take_free(std::uint32_t level);
};

/// Bulk loads the empty `storage` with the entries whose boxes are not empty; `fill` slots of each node are used.
template <typename Payload>
void bulk_load(Storage<ExactLeaf<Payload>>& storage, std::span<const Entry<Payload>> entries, std::size_t fill);
/// Bulk loads boxes that stay where they are, each with its index as its payload.
void bulk_load(Storage<IndexLeaf>& storage, std::span<const Box3> boxes);
/// Adds an entry whose box is not empty.
template <typename Payload>
void insert(Storage<ExactLeaf<Payload>>& storage, const Entry<Payload>& entry);
/// Removes one entry equal to `entry`; false if there is none.
template <typename Payload>
bool erase(Storage<ExactLeaf<Payload>>& storage, const Entry<Payload>& entry);

}  // namespace rtree
