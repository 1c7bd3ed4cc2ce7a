#include <algorithm>

#include "base/scheduler.h"
#include "rtree/detail/cursors.h"
#include "rtree/detail/translation.h"

namespace rtree {
namespace {

// A batch is to have about so many pairs.
constexpr std::size_t kFewPairs = std::size_t{1} << 13;
constexpr std::size_t kManyPairs = std::size_t{1} << 16;
constexpr std::size_t kMostTasks = std::size_t{1} << 12;
// Tasks that are worth a thread.
constexpr std::size_t kTaskGrain = 32;

SlotMask slots_after(std::size_t slot) {
  return ~((SlotMask{2} << slot) - 1);
}

}  // namespace

template <typename Leaf>
BasicJoinCursor<Leaf>::BasicJoinCursor(const TreeView<Leaf>& first, const TreeView<Leaf>& second)
    : first_(first), second_(second), exact_first_(first), exact_second_(second), within_one_(false) {
  if (first.empty() || second.empty()) return;
  // Keys are compared in one frame: that of the larger tree, so that the work is that of the smaller one.
  if (first.frame != second.frame) {
    TreeView<Leaf>& smaller = first.entry_count < second.entry_count ? first_ : second_;
    const TreeView<Leaf>& larger = first.entry_count < second.entry_count ? second_ : first_;
    translated_ = std::make_shared<const Translation<Leaf>>(smaller, larger.frame);
    smaller = translated_->view();
  }
  tasks_.push_back({first.root, second.root, first.height, second.height});
}

template <typename Leaf>
BasicJoinCursor<Leaf>::BasicJoinCursor(const TreeView<Leaf>& tree) : BasicJoinCursor(tree, tree) {
  within_one_ = true;
}

// The batch grows while it gives few pairs: the first pair comes soon, and then there is work for all threads.
template <typename Leaf>
bool BasicJoinCursor<Leaf>::refill() {
  pairs_.clear();
  position_ = 0;
  while (pairs_.empty() && !tasks_.empty()) {
    const std::vector<Task> tasks = next_tasks();
    pairs_ = algebra3d::parallel_collect(tasks.size(), kTaskGrain, [&](std::size_t begin, std::size_t end) {
      Pairs pairs;
      for (std::size_t i = begin; i < end; ++i) match(tasks[i], pairs);
      return pairs;
    });
    if (pairs_.size() < kFewPairs) batch_tasks_ = std::min(batch_tasks_ * 2, kMostTasks);
    if (pairs_.size() > kManyPairs) batch_tasks_ = std::max(batch_tasks_ / 2, std::size_t{1});
  }
  return !pairs_.empty();
}

// Pairs of nodes just above the leaves, or of leaves.
template <typename Leaf>
auto BasicJoinCursor<Leaf>::next_tasks() -> std::vector<Task> {
  std::vector<Task> tasks;
  while (!tasks_.empty() && tasks.size() < batch_tasks_) {
    const Task task = tasks_.back();
    tasks_.pop_back();
    if (std::max(task.first_level, task.second_level) <= 1 && task.first_level == task.second_level)
      tasks.push_back(task);
    else
      expand(task);
  }
  return tasks;
}

template <typename Leaf>
void BasicJoinCursor<Leaf>::expand(const Task& task) {
  if (within_one_ && task.first == task.second) return expand_self(task);
  if (task.first_level == task.second_level) return expand_both(task);
  if (task.first_level > task.second_level) {
    const InnerNode& node = first_.inner_node(task.first, task.first_level);
    const KeyBox box = second_.node(task.second, task.second_level).bounds();
    for (SlotMask slots = scans_->meeting(node, box); slots != 0;)
      tasks_.push_back({node.reference[take_slot(slots)], task.second, task.first_level - 1, task.second_level});
    return;
  }
  const InnerNode& node = second_.inner_node(task.second, task.second_level);
  const KeyBox box = first_.node(task.first, task.first_level).bounds();
  for (SlotMask slots = scans_->meeting(node, box); slots != 0;)
    tasks_.push_back({task.first, node.reference[take_slot(slots)], task.first_level, task.second_level - 1});
}

// Only children that meet the other node are compared with its children: many pairs of nodes overlap in a small part.
template <typename Leaf>
void BasicJoinCursor<Leaf>::expand_both(const Task& task) {
  const InnerNode& first = first_.inner_node(task.first, task.first_level);
  const InnerNode& second = second_.inner_node(task.second, task.second_level);
  const std::uint32_t level = task.first_level - 1;
  for (SlotMask rows = scans_->meeting(first, second.bounds()); rows != 0;) {
    const std::size_t row = take_slot(rows);
    for (SlotMask columns = scans_->meeting(second, first.box(row)); columns != 0;)
      tasks_.push_back({first.reference[row], second.reference[take_slot(columns)], level, level});
  }
}

template <typename Leaf>
void BasicJoinCursor<Leaf>::expand_self(const Task& task) {
  const InnerNode& node = first_.inner_node(task.first, task.first_level);
  const std::uint32_t level = task.first_level - 1;
  for (std::size_t row = 0; row < kFanOut && node.is_used(row); ++row) {
    for (SlotMask columns = scans_->meeting(node, node.box(row)) & slots_after(row); columns != 0;)
      tasks_.push_back({node.reference[row], node.reference[take_slot(columns)], level, level});
    tasks_.push_back({node.reference[row], node.reference[row], level, level});
  }
}

template <typename Leaf>
void BasicJoinCursor<Leaf>::match(const Task& task, Pairs& pairs) const {
  const bool is_self = within_one_ && task.first == task.second;
  if (task.first_level == 0) {
    if (is_self) return match_within(task.first, pairs);
    return match_leaves(task.first, task.second, 0xffff, pairs);
  }
  const InnerNode& first = first_.inner_node(task.first, task.first_level);
  const InnerNode& second = second_.inner_node(task.second, task.second_level);
  for (SlotMask rows = is_self ? 0xffff : scans_->meeting(first, second.bounds()); rows != 0;) {
    const std::size_t row = take_slot(rows);
    if (!first.is_used(row)) return;
    SlotMask columns = scans_->meeting(second, first.box(row));
    if (is_self) {
      match_within(first.reference[row], pairs);
      columns &= slots_after(row);
    }
    while (columns != 0) {
      const std::size_t column = take_slot(columns);
      const SlotMask meeting = scans_->meeting(first_.leaf(first.reference[row]), second.box(column));
      match_leaves(first.reference[row], second.reference[column], meeting, pairs);
    }
  }
}

template <typename Leaf>
void BasicJoinCursor<Leaf>::match_leaves(NodeIndex first, NodeIndex second, SlotMask rows, Pairs& pairs) const {
  const Leaf& first_leaf = first_.leaf(first);
  const Leaf& second_leaf = second_.leaf(second);
  Meeting meetings[kFanOut];
  scans_->meeting_rows(first_leaf, rows, second_leaf, meetings);
  while (rows != 0) {
    const std::size_t row = take_slot(rows);
    SlotMask columns = meetings[row].slots();
    for (SlotMask open = meetings[row].open(); open != 0;) {
      const std::size_t column = take_slot(open);
      if (!exact_first_.exact_box(first, row).intersects(exact_second_.exact_box(second, column)))
        columns &= ~(SlotMask{1} << column);
    }
    while (columns != 0) emit(first_leaf.reference[row], second_leaf.reference[take_slot(columns)], pairs);
  }
}

template <typename Leaf>
void BasicJoinCursor<Leaf>::match_within(NodeIndex index, Pairs& pairs) const {
  const Leaf& leaf = first_.leaf(index);
  for (std::size_t row = 0; row < kFanOut && leaf.is_used(row); ++row) {
    const Meeting meeting = scans_->meeting_exactly(leaf, leaf.box(row));
    for (SlotMask columns = meeting.slots() & slots_after(row); columns != 0;) {
      const std::size_t column = take_slot(columns);
      if ((meeting.open() >> column & 1) != 0 &&
          !first_.exact_box(index, row).intersects(first_.exact_box(index, column)))
        continue;
      emit(leaf.reference[row], leaf.reference[column], pairs);
    }
  }
}

template <typename Leaf>
void BasicJoinCursor<Leaf>::emit(Payload first, Payload second, Pairs& pairs) const {
  if (within_one_ && second < first) std::swap(first, second);
  pairs.push_back({first, second});
}

template class BasicJoinCursor<IndexLeaf>;
template class BasicJoinCursor<ExactLeaf<std::uint32_t>>;
template class BasicJoinCursor<ExactLeaf<std::uint64_t>>;

}  // namespace rtree
