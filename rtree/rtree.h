#pragma once

#include <span>
#include <string>
#include <vector>

#include "rtree/cursors.h"

namespace rtree {

/// R-tree in memory over closed boxes in space, each with a payload: std::uint32_t (element of a mesh) or
/// std::uint64_t (tuple).
///
/// Touching boxes meet. The same entry may be stored several times. Entries with an empty box are not stored: what
/// has no box meets nothing. At most 2^32 - 1 entries can be bulk loaded, and 2^32 - 1 nodes stored.
/// The same operations in the same order give the same results in the same order; a bulk-loaded tree does not depend
/// on the order of its entries.
/// A cursor refers to the tree, which must outlive it and must not be changed while it is in use. Const members may
/// run in parallel.
template <typename Payload>
class RTree {
 public:
  RTree() = default;

  /// A tree over all `entries` at once: fuller nodes, and faster to build and to search, than one made by inserts.
  /// Cost: n log n.
  static RTree bulk_load(std::span<const Entry<Payload>> entries);

  /// Stores the entry; false if the box is empty. Cost: logarithmic.
  bool insert(const Box3& box, Payload payload);
  /// Removes one entry of this very box and payload; false if there is none.
  /// Cost: logarithmic as long as few boxes cover the place.
  bool erase(const Box3& box, Payload payload);
  void clear() { storage_ = {}; }

  /// The entries that meet `window`: `for (auto id : tree.window(box))`.
  WindowCursor<Payload> window(const Box3& window) const { return {storage_, window}; }
  /// The entries by growing distance from `box`, equal distances by payload; no more than `limit`.
  NearestCursor<Payload> nearest(const Box3& box, std::size_t limit = SIZE_MAX) const { return {storage_, box, limit}; }
  /// The pairs of an entry of this tree and an entry of `other` that meet.
  JoinCursor<Payload> join(const RTree& other) const { return {storage_, other.storage_}; }
  /// The pairs of different entries of this tree that meet, each once, the smaller payload first.
  JoinCursor<Payload> self_join() const { return JoinCursor<Payload>(storage_); }

  std::size_t size() const { return storage_.entry_count; }
  bool empty() const { return size() == 0; }
  /// Smallest box around all entries.
  Box3 bounds() const;
  /// Bytes on the heap, reserved ones included.
  std::size_t heap_bytes() const;

  /// The nodes, for `audit`.
  const Storage<Payload>& storage() const { return storage_; }

 private:
  Storage<Payload> storage_;
};

/// Calls `visit(first, second)` for every pair of different entries that meet, each pair once, the smaller payload
/// first. `visit` must not change the tree.
template <typename Payload, typename Visit>
void for_each_pair(const RTree<Payload>& tree, Visit visit) {
  auto cursor = tree.self_join();
  for (auto batch = cursor.next_batch(); !batch.empty(); batch = cursor.next_batch())
    for (const auto& [first, second] : batch) visit(first, second);
}

/// Every violated invariant of Storage, in words; empty if all is well. Cost: linear.
template <typename Payload>
std::vector<std::string> audit(const RTree<Payload>& tree);
/// The same on bare nodes.
template <typename Payload>
std::vector<std::string> audit(const Storage<Payload>& storage);

}  // namespace rtree
