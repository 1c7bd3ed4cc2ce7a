#pragma once

#include <vector>

#include "rtree/large_allocator.h"
#include "rtree/node.h"

namespace rtree {

/// What a node's boxes do not say.
struct NodeInfo {
  NodeIndex parent = kNoNode;
  std::uint16_t count = 0;  ///< used slots
  std::uint16_t level = 0;  ///< 0 for leaves
};

/// The nodes of one tree in flat arrays; what the algorithms on trees work on.
/// Invariants (those that `audit` checks): all leaves have level 0 and the same depth; the box of a child's slot is
/// the union of the child's boxes; every node but the root has at least kMinFill used slots, an inner root two; every
/// node is either reachable from the root exactly once or listed in `free_nodes`.
template <typename Payload>
struct Storage {
  std::vector<Node<Payload>, LargeAllocator<Node<Payload>>> nodes;
  std::vector<NodeInfo> infos;  ///< parallel to `nodes`
  std::vector<NodeIndex> free_nodes;
  NodeIndex root = kNoNode;
  std::size_t entry_count = 0;

  /// A node without slots in use, without a parent.
  NodeIndex add_node(std::size_t level);
  /// Gives the node's place back; it must have been taken out of its parent.
  void free_node(NodeIndex node);

  /// Appends to a node that is not full; a child gets the node as its parent.
  void append(NodeIndex node, const Entry<Payload>& entry);
  /// Takes a slot out; the last used slot moves into its place.
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

/// Fills the empty `storage` with the entries of non-empty boxes.
template <typename Payload>
void bulk_load(Storage<Payload>& storage, const Entry<Payload>* entries, std::size_t count);
/// Adds an entry whose box is not empty.
template <typename Payload>
void insert(Storage<Payload>& storage, const Entry<Payload>& entry);
/// Removes one entry equal to `entry`; false if there is none.
template <typename Payload>
bool erase(Storage<Payload>& storage, const Entry<Payload>& entry);

}  // namespace rtree
