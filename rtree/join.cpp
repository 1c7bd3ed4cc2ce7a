#include <algorithm>

#include "rtree/detail/cursors.h"

namespace rtree {
namespace {

constexpr std::size_t kBatchSize = 512;

SlotMask slots_after(std::size_t slot) {
  return ~((SlotMask{2} << slot) - 1);
}

}  // namespace

template <typename Payload>
JoinCursor<Payload>::JoinCursor(const Storage<Payload>& first, const Storage<Payload>& second)
    : first_(&first), second_(&second), within_one_(false) {
  if (first.root == kNoNode || second.root == kNoNode) return;
  tasks_.push_back({first.root, second.root, static_cast<std::uint32_t>(first.height()),
                    static_cast<std::uint32_t>(second.height()), second.bounds(second.root)});
}

template <typename Payload>
JoinCursor<Payload>::JoinCursor(const Storage<Payload>& storage) : JoinCursor(storage, storage) {
  within_one_ = true;
}

template <typename Payload>
bool JoinCursor<Payload>::refill() {
  pairs_.clear();
  position_ = 0;
  pairs_.reserve(kBatchSize + kFanOut * kFanOut);
  while (!tasks_.empty() && pairs_.size() < kBatchSize) {
    const Task task = tasks_.back();
    tasks_.pop_back();
    expand(task);
  }
  return !pairs_.empty();
}

template <typename Payload>
void JoinCursor<Payload>::expand(const Task& task) {
  if (within_one_ && task.first == task.second) return expand_self(task);
  if (task.first_level == task.second_level) return task.first_level == 0 ? match_leaves(task) : expand_both(task);
  if (task.first_level > task.second_level) {
    const Node<Payload>& node = first_->nodes[task.first];
    for (SlotMask slots = slots_meeting(node, task.second_box); slots != 0;)
      tasks_.push_back(
          {node.child(take_slot(slots)), task.second, task.first_level - 1, task.second_level, task.second_box});
    return;
  }
  const Node<Payload>& node = second_->nodes[task.second];
  for (SlotMask slots = slots_meeting(node, first_->bounds(task.first)); slots != 0;) {
    const std::size_t slot = take_slot(slots);
    tasks_.push_back({task.first, node.child(slot), task.first_level, task.second_level - 1, node.box(slot)});
  }
}

// Only children that meet the other node are compared with its children: many pairs of nodes overlap in a small part.
template <typename Payload>
void JoinCursor<Payload>::expand_both(const Task& task) {
  const Node<Payload>& first = first_->nodes[task.first];
  const Node<Payload>& second = second_->nodes[task.second];
  const std::uint32_t level = task.first_level - 1;
  for (SlotMask rows = slots_meeting(first, task.second_box); rows != 0;) {
    const std::size_t row = take_slot(rows);
    for (SlotMask columns = slots_meeting(second, first.box(row)); columns != 0;) {
      const std::size_t column = take_slot(columns);
      tasks_.push_back({first.child(row), second.child(column), level, level, second.box(column)});
    }
  }
}

template <typename Payload>
void JoinCursor<Payload>::expand_self(const Task& task) {
  if (task.first_level == 0) return match_within(task.first);
  const Node<Payload>& node = first_->nodes[task.first];
  const std::uint32_t level = task.first_level - 1;
  const std::size_t count = first_->infos[task.first].count;
  for (std::size_t row = 0; row < count; ++row) {
    const Box3 box = node.box(row);
    for (SlotMask columns = slots_meeting(node, box) & slots_after(row); columns != 0;) {
      const std::size_t column = take_slot(columns);
      tasks_.push_back({node.child(row), node.child(column), level, level, node.box(column)});
    }
    tasks_.push_back({node.child(row), node.child(row), level, level, box});
  }
}

template <typename Payload>
void JoinCursor<Payload>::match_leaves(const Task& task) {
  const Node<Payload>& first = first_->nodes[task.first];
  const Node<Payload>& second = second_->nodes[task.second];
  for (SlotMask rows = slots_meeting(first, task.second_box); rows != 0;) {
    const std::size_t row = take_slot(rows);
    for (SlotMask columns = slots_meeting(second, first.box(row)); columns != 0;)
      emit(first.reference[row], second.reference[take_slot(columns)]);
  }
}

template <typename Payload>
void JoinCursor<Payload>::match_within(NodeIndex leaf) {
  const Node<Payload>& node = first_->nodes[leaf];
  const std::size_t count = first_->infos[leaf].count;
  for (std::size_t row = 0; row < count; ++row)
    for (SlotMask columns = slots_meeting(node, node.box(row)) & slots_after(row); columns != 0;)
      emit(node.reference[row], node.reference[take_slot(columns)]);
}

template <typename Payload>
void JoinCursor<Payload>::emit(Payload first, Payload second) {
  if (within_one_ && second < first) std::swap(first, second);
  pairs_.push_back({first, second});
}

template class JoinCursor<std::uint32_t>;
template class JoinCursor<std::uint64_t>;

}  // namespace rtree
