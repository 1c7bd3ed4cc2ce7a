#include "rtree/detail/leaf_array.h"

#include <algorithm>

#include <fmt/format.h>

namespace rtree {
namespace {

// What is beyond a remainder would change the key.
bool are_sound(const Remainders& remainders, const KeyFrame& frame) {
  std::uint32_t excess = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto limit = static_cast<std::uint32_t>(frame.axes[axis].remainders());
    for (std::size_t slot = 0; slot < kFanOut; ++slot)
      excess |= (remainders.min[axis][slot] | remainders.max[axis][slot]) & ~limit;
  }
  return excess == 0;
}

}  // namespace

template <typename Leaf>
bool accept(Leaf& leaf, bool is_free, const LeafRules& rules) {
  if (!is_free) return leaf.is_sound(rules.fewest) && are_sound(leaf.remainders, rules.frame);
  leaf.clear();
  std::ranges::fill(leaf.reference, 0);
  leaf.remainders.clear();
  return true;
}

template <typename Leaf>
LeafArray<Leaf>::LeafArray(std::size_t count, LeafReader reader, LeafRules rules)
    : pending_(new Pending{count, std::move(reader), std::move(rules), {}, {}}) {
  // An array without room would be copied with the first new leaf, and the leaves that were not read would take memory.
  constexpr std::size_t kLeastRoom = 64;
  leaves_.reserve(count + count / 16 + kLeastRoom);
  leaves_.resize(count);
  const std::size_t at_once = pending_->reader.leaves_at_once;
  pending_->blocks = std::make_unique<std::atomic<bool>[]>((count + at_once - 1) / at_once);
}

template <typename Leaf>
void LeafArray<Leaf>::read(std::size_t leaf) const {
  const std::lock_guard lock(pending_->reading);
  if (pending_->is_read(leaf)) return;
  const std::size_t at_once = pending_->reader.leaves_at_once;
  const std::size_t first = leaf / at_once * at_once, last = std::min(first + at_once, pending_->count);
  pending_->reader.read(first * sizeof(Leaf), std::as_writable_bytes(std::span(leaves_).subspan(first, last - first)));
  for (std::size_t i = first; i < last; ++i)
    if (!accept(leaves_[i], pending_->rules.free.has(static_cast<NodeIndex>(i)), pending_->rules))
      throw DamagedImage(fmt::format("leaf {} of an R-tree is damaged", i));
  pending_->blocks[leaf / at_once].store(true, std::memory_order_release);
}

template class LeafArray<ExactLeaf<std::uint32_t>>;
template class LeafArray<ExactLeaf<std::uint64_t>>;
template bool accept(ExactLeaf<std::uint32_t>&, bool, const LeafRules&);
template bool accept(ExactLeaf<std::uint64_t>&, bool, const LeafRules&);

}  // namespace rtree
