#include "rtree/detail/unread_nodes.h"

#include <algorithm>

#include <fmt/format.h>

namespace rtree {
namespace {

template <typename... Args>
[[noreturn]] void damaged(fmt::format_string<Args...> format, Args&&... args) {
  throw DamagedImage("image of an R-tree: " + fmt::format(format, std::forward<Args>(args)...));
}

// A remainder beyond its limit would change the key.
bool are_sound(const Remainders& remainders, const KeyFrame& frame) {
  std::uint32_t excess = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto limit = static_cast<std::uint32_t>(frame.axes[axis].remainders());
    for (std::size_t slot = 0; slot < kFanOut; ++slot)
      excess |= (remainders.min[axis][slot] | remainders.max[axis][slot]) & ~limit;
  }
  return excess == 0;
}

// So many blocks have to be read before an array is taken for one of which much is read.
constexpr std::size_t kFewBlocks = 16;
// Blocks before one that is to be read, by which it is decided whether others are read with it, and how many.
constexpr std::size_t kNeighbours = 8, kMostNeighbours = 6, kNeighbourhood = 64;

}  // namespace

template <typename Node>
UnreadArray<Node>::UnreadArray(LargeVector<Node>& nodes, NodeReader reader)
    : count_(reader.bytes / sizeof(Node)), reader_(std::move(reader)) {
  // An array without room would be copied with the first new node, and the nodes that were not read would take memory.
  constexpr std::size_t kLeastRoom = 64;
  nodes.reserve(count_ + count_ / 16 + kLeastRoom);
  algebra3d::avoid_huge_pages(nodes.data(), nodes.capacity() * sizeof(Node));
  nodes.resize(count_);
  nodes_ = nodes.data();
  states_ = std::make_unique<std::atomic<State>[]>(count_);
  has_block_.resize((count_ + reader_.nodes_at_once - 1) / reader_.nodes_at_once);
}

template <typename Node>
bool UnreadArray<Node>::name(NodeIndex node, std::uint32_t level) {
  if (node >= count_ || !is_unnamed(node)) return false;
  states_[node].store(named(level), std::memory_order_relaxed);
  return true;
}

// Where most blocks just before have been read, more are read at once: scattered questions read what they need, and a
// walk through many neighbours reads them in runs, whatever the order of threads.
template <typename Node>
std::size_t UnreadArray<Node>::run_length(std::size_t first_block) const {
  const auto here = has_block_.begin() + static_cast<std::ptrdiff_t>(first_block);
  const auto read_of = [&](std::size_t before) {
    const auto begin = here - static_cast<std::ptrdiff_t>(std::min(first_block, before));
    return static_cast<std::size_t>(std::count(begin, here, true));
  };
  if (read_of(kNeighbours) < kMostNeighbours) return 1;
  const std::size_t end = std::min(first_block + 1 + read_of(kNeighbourhood) / 2, has_block_.size());
  std::size_t block = first_block + 1;
  while (block < end && !has_block_[block]) ++block;
  return block - first_block;
}

template <typename Node>
const Node& UnreadArray<Node>::read(NodeIndex node) {
  const std::size_t block = node / reader_.nodes_at_once;
  if (has_block_[block]) return nodes_[node];
  const std::size_t blocks = run_length(block);
  const std::size_t first = block * reader_.nodes_at_once;
  const std::size_t last = std::min(first + blocks * reader_.nodes_at_once, count_);
  reader_.read(first * sizeof(Node), std::as_writable_bytes(std::span(nodes_ + first, last - first)));
  std::fill_n(has_block_.begin() + static_cast<std::ptrdiff_t>(block), blocks, true);
  const bool were_few = read_blocks_ < kFewBlocks;
  read_blocks_ += blocks;
  // Clearing a huge page takes longer than reading few blocks; walking through many nodes takes longer without.
  if (were_few && read_blocks_ >= kFewBlocks) algebra3d::prefer_huge_pages(nodes_, count_ * sizeof(Node));
  return nodes_[node];
}

template <typename Leaf>
UnreadNodes<Leaf>::UnreadNodes(LargeVector<InnerNode>& inner, LargeVector<Leaf>& leaves, NodeReader inner_reader,
                               NodeReader leaf_reader, const Tree& tree)
    : inner_(inner, std::move(inner_reader)), leaves_(leaves, std::move(leaf_reader)), tree_(tree) {
  static_cast<void>(tree.height == 0 ? leaves_.name(tree.root, 0) : inner_.name(tree.root, tree.height));
}

template <typename Leaf>
std::size_t UnreadNodes<Leaf>::fewest_slots(std::uint32_t level) const {
  if (level < tree_.height) return kMinFill;
  return level == 0 ? 1 : 2;
}

template <typename Leaf>
void UnreadNodes<Leaf>::reach(NodeIndex node, std::uint32_t level) {
  const std::lock_guard lock(reading_);
  if (level == 0)
    reach_leaf(node);
  else
    reach_inner(node, level);
}

template <typename Leaf>
void UnreadNodes<Leaf>::reach_leaf(NodeIndex node) {
  if (leaves_.is_reached(node, 0)) return;  // another thread was first
  const Leaf& leaf = leaves_.read(node);
  if (!leaves_.is_named(node, 0) || !leaf.is_sound(fewest_slots(0)) || !are_sound(leaf.remainders, tree_.frame))
    damaged("leaf {} is damaged", node);
  leaves_.set_reached(node, 0);
}

template <typename Leaf>
void UnreadNodes<Leaf>::reach_inner(NodeIndex node, std::uint32_t level) {
  if (inner_.is_reached(node, level)) return;
  const InnerNode& inner = inner_.read(node);
  if (!inner_.is_named(node, level) || !inner.is_sound(fewest_slots(level))) damaged("inner node {} is damaged", node);
  for (std::size_t slot = 0; slot < kFanOut && inner.is_used(slot); ++slot) {
    const NodeIndex child = inner.reference[slot];
    if (!(level == 1 ? leaves_.name(child, 0) : inner_.name(child, level - 1)))
      damaged("inner node {} names node {}", node, child);
  }
  inner_.set_reached(node, level);
}

// From the top, since nodes are named by those above them. Nodes that nobody names must be free.
template <typename Leaf>
void UnreadNodes<Leaf>::need_all() {
  const std::lock_guard lock(reading_);
  if (!is_needed()) return;
  for (std::uint32_t level = tree_.height; level > 0; --level)
    for (NodeIndex node = 0; node < inner_.count(); ++node)
      if (inner_.is_named(node, level)) reach_inner(node, level);
  for (NodeIndex node = 0; node < inner_.count(); ++node)
    if (inner_.is_unnamed(node) && !inner_.read(node).is_clear()) damaged("inner node {} is not named", node);
  for (NodeIndex node = 0; node < leaves_.count(); ++node) {
    if (leaves_.is_named(node, 0)) reach_leaf(node);
    if (leaves_.is_unnamed(node) && !leaves_.read(node).is_clear()) damaged("leaf {} is not named", node);
  }
  has_all_.store(true, std::memory_order_release);
}

template <typename Leaf>
void UnreadNodes<Leaf>::take_free(NodeIndex node, std::uint32_t level) {
  const auto take = [&](auto& array) {
    if (node >= array.count()) return;
    if (!array.is_unnamed(node) || !array.read(node).is_clear()) damaged("node {} is listed as free", node);
    array.set_reached(node, level);
  };
  if (level == 0)
    take(leaves_);
  else
    take(inner_);
}

template <typename Leaf>
void UnreadNodes<Leaf>::set_free(NodeIndex node, std::uint32_t level) {
  if (level == 0 && node < leaves_.count()) leaves_.set_unnamed(node);
  if (level > 0 && node < inner_.count()) inner_.set_unnamed(node);
}

template <typename Leaf>
void UnreadNodes<Leaf>::move_to(InnerNode* inner, Leaf* leaves) {
  inner_.move_to(inner);
  leaves_.move_to(leaves);
}

template class UnreadArray<InnerNode>;
template class UnreadArray<ExactLeaf<std::uint32_t>>;
template class UnreadArray<ExactLeaf<std::uint64_t>>;
template class UnreadNodes<ExactLeaf<std::uint32_t>>;
template class UnreadNodes<ExactLeaf<std::uint64_t>>;

}  // namespace rtree
