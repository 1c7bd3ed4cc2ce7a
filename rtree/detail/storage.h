#pragma once

#include <vector>

#include "algebra3d/base/large_allocator.h"
#include "rtree/detail/node.h"

namespace rtree {

/// The properties of a node besides its boxes.
struct NodeInfo {
  NodeIndex parent = kNoNode;
  std::uint16_t count = 0;  ///< used slots
  std::uint16_t level = 0;  ///< 0 for leaves
};

/// The nodes of a tree in flat arrays. Invariants (those that `audit` checks): all leaves have level 0 and the same
/// depth; the box of a child's slot is the union of the child's boxes; every node but the root has at least kMinFill
/// used slots, an inner root two; every node is either reachable from the root exactly once or listed in `free_nodes`.
template <typename Payload>
struct Storage {
  std::vector<Node<Payload>, algebra3d::LargeAllocator<Node<Payload>>> nodes;
  std::vector<NodeInfo> infos;  ///< parallel to `nodes`
  std::vector<NodeIndex> free_nodes;
  NodeIndex root = kNoNode;
  std::size_t entry_count = 0;

  /// Adds an empty node without a parent.
  NodeIndex add_node(std::size_t level);
  /// Frees a node that has been removed from its parent.
  void free_node(NodeIndex node);

  /// Appends an entry to a node that is not full; sets the parent of a child.
  void append(NodeIndex node, const Entry<Payload>& entry);
  /// Removes a slot; the last used slot moves to its position.
  void remove_slot(NodeIndex node, std::size_t slot);
  /// Empties the node.
  void clear(NodeIndex node);

  /// Union of the node's boxes.
  Box3 bounds(NodeIndex node) const;
  /// The slot of `node` in its parent.
  std::size_t slot_in_parent(NodeIndex node) const;
  /// Level of the root; 0 for the empty tree.
  std::size_t height() const { return root == kNoNode ? 0 : infos[root].level; }
};

/// Bulk loads the empty `storage` with the entries whose boxes are not empty.
template <typename Payload>
void bulk_load(Storage<Payload>& storage, const Entry<Payload>* entries, std::size_t count);
/// Adds an entry whose box is not empty.
template <typename Payload>
void insert(Storage<Payload>& storage, const Entry<Payload>& entry);
/// Removes one entry equal to `entry`; false if there is none.
template <typename Payload>
bool erase(Storage<Payload>& storage, const Entry<Payload>& entry);

}  // namespace rtree
