#pragma once

#include <array>
#include <new>
#include <utility>
#include <vector>

#include "algebra3d/base/large_allocator.h"
#include "rtree/detail/node.h"

namespace rtree {

/// An allocator that leaves new elements without initial values: they are written next, by several threads.
template <typename T>
struct PlainAllocator : algebra3d::LargeAllocator<T> {
  PlainAllocator() = default;
  template <typename U>
  explicit PlainAllocator(const PlainAllocator<U>&) {}

  template <typename U>
  void construct(U* place) {
    ::new (static_cast<void*>(place)) U;
  }
  template <typename U, typename... Args>
  void construct(U* place, Args&&... args) {
    ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
  }
};
template <typename T>
using LargeVector = std::vector<T, PlainAllocator<T>>;

/// A tree as cursors see it: arrays of nodes that name each other by index, wherever they lie.
template <typename Payload>
struct TreeView {
  const InnerNode* inner = nullptr;
  const Node<Payload>* leaves = nullptr;
  std::size_t inner_count = 0, leaf_count = 0;
  // Where the exact boxes are: either of the two.
  const Remainders* remainders = nullptr;  ///< parallel to `leaves`
  const Box3* boxes = nullptr;             ///< by payload
  KeyFrame frame;
  NodeIndex root = 0;  ///< a leaf if the height is 0, else an inner node
  std::uint32_t height = 0;
  std::size_t entry_count = 0;

  bool empty() const { return entry_count == 0; }
  const KeyBoxes& node(NodeIndex index, std::uint32_t level) const {
    return level == 0 ? static_cast<const KeyBoxes&>(leaves[index]) : inner[index];
  }
  OrderedBox exact_box(NodeIndex leaf, std::size_t slot) const {
    if (remainders == nullptr) return OrderedBox::of(boxes[leaves[leaf].reference[slot]]);
    return rtree::exact_box(frame, leaves[leaf], remainders[leaf], slot);
  }
  void prefetch_exact_box(NodeIndex leaf, std::size_t slot) const {
    if (remainders != nullptr) return;  // next to each other, and soon read
    const auto* bytes = reinterpret_cast<const char*>(boxes + leaves[leaf].reference[slot]);
    __builtin_prefetch(bytes);
    __builtin_prefetch(bytes + sizeof(Box3) - 1);
  }
  /// Smallest box around all entries. Cost: that of finding the entries whose keys are those of the whole tree.
  Box3 bounds() const;
};

/// What a slot holds: the box of an entry with its payload, or that of a child with its index.
template <typename Payload>
struct SlotContent {
  OrderedBox box;
  Payload reference;
};

/// A slot of an inner node on the way from the root to a leaf.
struct PathStep {
  NodeIndex node;
  std::size_t slot;
};
/// The way to a leaf: the step from level L + 1 to level L at position L.
using Path = std::array<PathStep, kMaxLevels>;

/// The nodes of a tree in flat arrays. Invariants (those that `audit` checks): all leaves have the same depth; the box
/// of a child's slot is the union of the child's boxes; every node but the root has at least kMinFill used slots, an
/// inner root two; every node is either reachable from the root exactly once or listed as free.
template <typename Payload>
struct Storage {
  LargeVector<InnerNode> inner;
  LargeVector<Node<Payload>> leaves;
  LargeVector<Remainders> remainders;  ///< parallel to `leaves`; empty if the boxes lie elsewhere
  std::vector<NodeIndex> free_inner, free_leaves;
  KeyFrame frame;
  NodeIndex root = 0;
  std::uint32_t height = 0;
  std::size_t entry_count = 0;

  bool empty() const { return entry_count == 0; }
  TreeView<Payload> view(const Box3* boxes = nullptr) const {
    return {inner.data(), leaves.data(), inner.size(), leaves.size(), boxes == nullptr ? remainders.data() : nullptr,
            boxes,        frame,         root,         height,        entry_count};
  }
  KeyBoxes& node(NodeIndex index, std::uint32_t level) {
    return level == 0 ? static_cast<KeyBoxes&>(leaves[index]) : inner[index];
  }
  std::size_t heap_bytes() const;

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
  /// Removes a slot; the last used slot moves to its position.
  void remove_slot(NodeIndex node, std::uint32_t level, std::size_t slot);
  /// Changes the keys of all nodes to a frame whose range has `box` besides. Cost: linear; the range at least doubles.
  void widen_frame(const OrderedBox& box);
};

/// Bulk loads the empty `storage` with the entries whose boxes are not empty.
template <typename Payload>
void bulk_load(Storage<Payload>& storage, const Entry<Payload>* entries, std::size_t count);
/// The same for boxes that stay where they are, each with its index as its payload.
void bulk_load(Storage<std::uint32_t>& storage, const Box3* boxes, std::size_t count);
/// Adds an entry whose box is not empty.
template <typename Payload>
void insert(Storage<Payload>& storage, const Entry<Payload>& entry);
/// Removes one entry equal to `entry`; false if there is none.
template <typename Payload>
bool erase(Storage<Payload>& storage, const Entry<Payload>& entry);

}  // namespace rtree
