#pragma once

#include <array>
#include <span>

#include "rtree/detail/split.h"
#include "rtree/detail/storage.h"

namespace rtree {

/// Contents of slots on their way into one or two nodes.
template <typename Payload>
class Redistribution {
 public:
  void take(const Storage<ExactLeaf<Payload>>& storage, NodeIndex node, std::uint32_t level) {
    const std::size_t count = storage.node(node, level).count();
    for (std::size_t slot = 0; slot < count; ++slot) take(storage.content(node, level, slot));
  }
  void take(const SlotContent<Payload>& content) {
    items_[count_] = {content.box.box(), content.reference, count_};
    contents_[count_++] = content;
  }

  /// Puts all into `first` if they fit, else by `split` into both. Returns how many `second` has.
  std::size_t distribute(Storage<ExactLeaf<Payload>>& storage, NodeIndex first, NodeIndex second, std::uint32_t level) {
    const std::span<SplitItem> items(items_.data(), count_);
    const std::size_t kept = count_ <= kFanOut ? count_ : split(items);
    storage.clear(first, level);
    storage.clear(second, level);
    for (std::size_t i = 0; i < count_; ++i)
      storage.set(i < kept ? first : second, level, i < kept ? i : i - kept, contents_[items[i].index]);
    return count_ - kept;
  }

 private:
  std::size_t count_ = 0;
  std::array<SplitItem, kMaxSplit> items_;
  std::array<SlotContent<Payload>, kMaxSplit> contents_;
};

/// A node as its parent has it.
template <typename Payload>
SlotContent<Payload> child_content(const Storage<ExactLeaf<Payload>>& storage, NodeIndex node, std::uint32_t level) {
  return {storage.frame.outer_box(storage.node(node, level).bounds()), Payload{node}};
}

}  // namespace rtree
