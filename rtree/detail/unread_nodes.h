#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "base/large_allocator.h"
#include "rtree/detail/node.h"
#include "rtree/image.h"

namespace rtree {

using algebra3d::LargeVector;

/// An array of nodes of an image, read by the block, and the state of each node.
template <typename Node>
class UnreadArray {
 public:
  /// Gives `nodes` their number; they have no values yet.
  UnreadArray(LargeVector<Node>& nodes, NodeReader reader);

  /// Number of nodes in the image.
  std::size_t count() const { return count_; }
  /// True if the node was found to be one of `level`, or is not one of the image.
  bool is_reached(NodeIndex node, std::uint32_t level) const {
    return node >= count_ || states_[node].load(std::memory_order_acquire) == reached(level);
  }
  bool is_named(NodeIndex node, std::uint32_t level) const { return state(node) == named(level); }
  bool is_unnamed(NodeIndex node) const { return state(node) == kUnnamed; }
  /// Records that a node of the level above has it as a child; false if it does not exist or was named before.
  bool name(NodeIndex node, std::uint32_t level);
  void set_reached(NodeIndex node, std::uint32_t level) {
    states_[node].store(reached(level), std::memory_order_release);
  }
  void set_unnamed(NodeIndex node) { states_[node].store(kUnnamed, std::memory_order_relaxed); }
  /// The node, which is read if it was not.
  const Node& read(NodeIndex node);
  /// To be called when the array lies elsewhere.
  void move_to(Node* nodes) { nodes_ = nodes; }

 private:
  using State = std::uint8_t;
  static constexpr State kUnnamed = 0;
  static constexpr State named(std::uint32_t level) { return static_cast<State>(0x80U | level); }
  static constexpr State reached(std::uint32_t level) { return static_cast<State>(level + 1); }

  State state(NodeIndex node) const { return states_[node].load(std::memory_order_relaxed); }
  std::size_t run_length(std::size_t first_block) const;

  Node* nodes_;
  std::size_t count_;
  NodeReader reader_;
  std::unique_ptr<std::atomic<State>[]> states_;
  std::vector<bool> has_block_;
  std::size_t read_blocks_ = 0;
};

/// The nodes of an image that are read when they are first reached, each from its parent. The content of a node is
/// followed only after it was found sound, and each node may be named once: so no bytes, however hostile, lead outside
/// of the arrays or around in circles. Concurrent calls of `need` and `need_all` are safe. Errors: these throw what the
/// readers throw, and DamagedImage.
template <typename Leaf>
class UnreadNodes {
 public:
  /// The facts of a tree that are known before its nodes are read.
  struct Tree {
    KeyFrame frame;
    NodeIndex root;
    std::uint32_t height;
  };

  /// All nodes that the readers have, into arrays that are not moved without `move_to`. The root exists.
  UnreadNodes(LargeVector<InnerNode>& inner, LargeVector<Leaf>& leaves, NodeReader inner_reader, NodeReader leaf_reader,
              const Tree& tree);

  /// Reads a node that the tree has at this level, if it was not read.
  void need(NodeIndex node, std::uint32_t level) {
    if (!(level == 0 ? leaves_.is_reached(node, 0) : inner_.is_reached(node, level))) reach(node, level);
  }
  /// Reads all, in runs.
  void need_all();
  /// False after need_all: everything is in the arrays.
  bool is_needed() const { return !has_all_.load(std::memory_order_acquire); }

  /// Reads a free node, which is to become one of `level`.
  void take_free(NodeIndex node, std::uint32_t level);
  /// Records that a node of the tree was freed.
  void set_free(NodeIndex node, std::uint32_t level);
  void move_to(InnerNode* inner, Leaf* leaves);

 private:
  void reach(NodeIndex node, std::uint32_t level);
  void reach_leaf(NodeIndex node);
  void reach_inner(NodeIndex node, std::uint32_t level);
  std::size_t fewest_slots(std::uint32_t level) const;

  UnreadArray<InnerNode> inner_;
  UnreadArray<Leaf> leaves_;
  Tree tree_;
  std::mutex reading_;
  std::atomic<bool> has_all_ = false;
};

/// The nodes of a tree that were not read yet. A copy of a tree has all in memory: for that, this is the member that
/// is copied first.
template <typename Leaf>
class UnreadPart {
 public:
  UnreadPart() = default;
  explicit UnreadPart(std::unique_ptr<UnreadNodes<Leaf>> nodes) : nodes_(std::move(nodes)) {}
  UnreadPart(const UnreadPart& other) { other.need_all(); }
  UnreadPart(UnreadPart&&) noexcept = default;
  UnreadPart& operator=(const UnreadPart& other) {
    other.need_all();
    if (this != &other) nodes_ = nullptr;
    return *this;
  }
  UnreadPart& operator=(UnreadPart&&) noexcept = default;
  ~UnreadPart() = default;

  /// Null if all has been read.
  UnreadNodes<Leaf>* get() const { return nodes_ != nullptr && nodes_->is_needed() ? nodes_.get() : nullptr; }
  void need_all() const {
    if constexpr (kHasRemainders<Leaf>)
      if (nodes_ != nullptr) nodes_->need_all();
  }

 private:
  std::unique_ptr<UnreadNodes<Leaf>> nodes_;
};

}  // namespace rtree
