#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <utility>

#include "algebra3d/base/large_allocator.h"
#include "rtree/detail/key_frame.h"
#include "rtree/detail/node_set.h"
#include "rtree/image.h"

namespace rtree {

using algebra3d::LargeVector;

/// What a reader of leaves has to know of a tree.
struct LeafRules {
  KeyFrame frame;
  std::size_t fewest;  ///< used slots
  NodeSet free;        ///< leaves that are empty, whatever is read
};

/// The leaves of a tree: all in memory, or those of an image that are read when they are first needed. Concurrent calls
/// of const members are safe. A copy has all in memory.
template <typename Leaf>
class LeafArray {
 public:
  LeafArray() = default;
  /// `count` leaves that are still to be read.
  LeafArray(std::size_t count, LeafReader reader, LeafRules rules);
  LeafArray(const LeafArray& other) : leaves_(other.all()) {}
  LeafArray(LeafArray&& other) noexcept = default;
  LeafArray& operator=(const LeafArray& other) {
    *this = LeafArray(other);
    return *this;
  }
  LeafArray& operator=(LeafArray&& other) noexcept = default;
  ~LeafArray() = default;

  std::size_t size() const { return leaves_.size(); }
  /// True if there may be leaves that are still to be read.
  bool is_pending() const { return pending_ != nullptr; }
  /// Reads a leaf if it was not. Errors: throws what the reader throws; DamagedImage.
  void need(std::size_t leaf) const {
    if constexpr (kHasRemainders<Leaf>)
      if (pending_ && leaf < pending_->count && !pending_->is_read(leaf)) read(leaf);
  }
  const Leaf& operator[](std::size_t leaf) const {
    need(leaf);
    return leaves_[leaf];
  }
  Leaf& operator[](std::size_t leaf) {
    need(leaf);
    return leaves_[leaf];
  }
  /// All leaves; reads those that were not.
  const LargeVector<Leaf>& all() const {
    for (std::size_t leaf = 0; leaf < size(); ++leaf) need(leaf);
    return leaves_;
  }
  /// The array, in which only leaves that were needed have their values.
  const Leaf* data() const { return leaves_.data(); }

  /// Sets the number; new leaves have no values yet.
  void resize(std::size_t count) { leaves_.resize(count); }
  std::size_t heap_bytes() const { return leaves_.capacity() * sizeof(Leaf); }

 private:
  struct Pending {
    std::size_t count;  // of leaves in the image
    LeafReader reader;
    LeafRules rules;
    std::mutex reading;
    std::unique_ptr<std::atomic<bool>[]> blocks;  // true if read

    bool is_read(std::size_t leaf) const {
      return blocks[leaf / reader.leaves_at_once].load(std::memory_order_acquire);
    }
  };

  void read(std::size_t leaf) const;

  mutable LargeVector<Leaf> leaves_;
  std::unique_ptr<Pending> pending_;
};

/// Empties a free leaf that was read, and says whether any other one is such as a tree has.
template <typename Leaf>
bool accept(Leaf& leaf, bool is_free, const LeafRules& rules);

}  // namespace rtree
