#pragma once

#include <span>
#include <string>
#include <vector>

#include "algebra3d/base/error.h"
#include "rtree/detail/cursors.h"
#include "rtree/image.h"

namespace rtree {

/// How many slots of its nodes a bulk load uses.
enum class Filling {
  full,              ///< all: smallest and fastest, but the first inserts split node after node
  room_for_changes,  ///< an eighth is left, so that few of the first inserts split nodes
};

/// An R-tree in memory over closed boxes in space, each with a payload: std::uint32_t (element of a mesh) or
/// std::uint64_t (tuple).
///
/// Touching boxes meet. Equal entries may be stored several times. Entries with an empty box are not stored, since they
/// meet nothing. At most 2^32 - 1 entries can be bulk loaded, and 2^32 - 1 nodes stored. Deterministic, for any number
/// of threads; a bulk-loaded tree does not depend on the order of its entries. The tree must outlive its cursors and
/// must not be changed while they are in use. Concurrent calls of const members are safe. The state can be stored and
/// taken back as it lies in memory: see image.h.
template <typename Payload>
class RTree {
 public:
  RTree() = default;

  /// Builds a tree over all `entries`: its nodes are fuller, and it is faster to build and to search than by inserts.
  /// Cost: linear, and if the payloads do not ascend that of sorting by them.
  static RTree bulk_load(std::span<const Entry<Payload>> entries, Filling filling = Filling::full);

  /// Stores the entry; false if the box is empty. Cost: logarithmic.
  bool insert(const Box3& box, Payload payload);
  /// Removes one entry with exactly this box and payload; false if there is none. Cost: logarithmic if few boxes
  /// overlap there.
  bool erase(const Box3& box, Payload payload);
  void clear() { *this = {}; }

  /// The whole state as bytes. Reads the nodes that were not read.
  ImageParts image() const;
  /// The changes to be written to an image that has the state of the last call: the header and the parts of the arrays
  /// that were changed by inserts and erases since, in whole nodes; all at the first call, and none after from_image.
  /// Where the arrays became shorter, the bytes beyond their end must be dropped.
  ImageParts take_changes();
  /// The tree of an image, whose nodes are read when they are first needed, and looked at then: all other members may
  /// throw what a reader throws, or DamagedImage. Whatever the bytes are, the tree can be used and changed without
  /// harm, but only bytes of an image give its answers. A copy has all nodes in memory. Errors: database_corrupt;
  /// database_version for an image of another version or byte order. Cost: linear, a byte for each node.
  static algebra3d::Result<RTree> from_image(std::span<const std::byte> header, NodeReader inner, NodeReader leaves);

  /// The entries that meet `window`: `for (auto id : tree.window(box))`.
  WindowCursor<Payload> window(const Box3& window) const { return {view(), window}; }
  /// At most `limit` entries by ascending distance from `box`, then by payload.
  NearestCursor<Payload> nearest(const Box3& box, std::size_t limit = SIZE_MAX) const { return {view(), box, limit}; }
  /// The pairs of an entry of this tree and an entry of `other` that meet.
  JoinCursor<Payload> join(const RTree& other) const { return {view(), other.view()}; }
  /// The pairs of different entries of this tree that meet, each once, the smaller payload first.
  JoinCursor<Payload> self_join() const { return JoinCursor<Payload>(view()); }

  std::size_t size() const { return storage_.entry_count; }
  bool empty() const { return size() == 0; }
  /// Smallest box around all entries.
  Box3 bounds() const { return view().bounds(); }
  /// All entries, in the order of the tree.
  std::vector<Entry<Payload>> entries() const;
  /// Bytes on the heap, with unused capacity.
  std::size_t heap_bytes() const { return storage_.heap_bytes(); }

  /// The nodes, for `audit`.
  const Storage<ExactLeaf<Payload>>& storage() const { return storage_; }

 private:
  TreeView<ExactLeaf<Payload>> view() const { return storage_.view(); }

  Storage<ExactLeaf<Payload>> storage_;
  bool is_stored_ = false;  // an image has all nodes but those that storage_ lists as changed
};

/// An R-tree over boxes that stay where they are, each named by its index: half the memory of RTree, and not to be
/// changed. The boxes must outlive the tree; else as RTree.
class BoxTree {
 public:
  BoxTree() = default;
  /// At most 2^32 - 1 boxes. Cost: linear.
  explicit BoxTree(std::span<const Box3> boxes);

  using WindowCursor = BasicWindowCursor<IndexLeaf>;
  using NearestCursor = BasicNearestCursor<IndexLeaf>;
  using JoinCursor = BasicJoinCursor<IndexLeaf>;

  WindowCursor window(const Box3& window) const { return {view(), window}; }
  NearestCursor nearest(const Box3& box, std::size_t limit = SIZE_MAX) const { return {view(), box, limit}; }
  JoinCursor join(const BoxTree& other) const { return {view(), other.view()}; }
  JoinCursor self_join() const { return JoinCursor(view()); }

  std::size_t size() const { return storage_.entry_count; }
  bool empty() const { return size() == 0; }
  Box3 bounds() const { return view().bounds(); }
  std::size_t heap_bytes() const { return storage_.heap_bytes(); }
  const Storage<IndexLeaf>& storage() const { return storage_; }

 private:
  TreeView<IndexLeaf> view() const { return storage_.view(boxes_); }

  Storage<IndexLeaf> storage_;
  const Box3* boxes_ = nullptr;
};

/// Calls `visit(first, second)` for every pair of different entries that meet, each pair once, the smaller payload
/// first. `visit` must not change the tree.
template <typename Payload, typename Visit>
void for_each_pair(const RTree<Payload>& tree, Visit visit) {
  auto cursor = tree.self_join();
  for (auto batch = cursor.next_batch(); !batch.empty(); batch = cursor.next_batch())
    for (const auto& [first, second] : batch) visit(first, second);
}

/// Lists every violated invariant of Storage; empty if all hold. Cost: linear.
template <typename Payload>
std::vector<std::string> audit(const RTree<Payload>& tree);
/// Lists every violated invariant of a Storage.
template <typename Leaf>
std::vector<std::string> audit(const Storage<Leaf>& storage);

}  // namespace rtree
