#include "queries/streams/detail/run_merge.h"

#include <algorithm>
#include <utility>

#include "base/propagate.h"

namespace queries {

SortOrder::SortOrder(const std::vector<SortKey>& keys) {
  for (const SortKey& key : keys) {
    attributes_.push_back(key.attribute);
    is_descending_.push_back(key.is_descending);
  }
}

std::strong_ordering SortOrder::compare_further(const KeyedTuple& a, const KeyedTuple& b) const {
  for (std::size_t i = 0; i < attributes_.size(); ++i) {
    const auto order = algebra3d::compare(a.key(attributes_, i), b.key(attributes_, i));
    if (order != 0) return is_descending_[i] ? 0 <=> order : order;
  }
  return std::strong_ordering::equal;
}

RunMerge::RunMerge(const std::shared_ptr<TupleFile>& file, std::span<const SortedRun> runs, SortOrder order,
                   const algebra3d::Context& context)
    : order_(std::move(order)), context_(context) {
  for (const SortedRun& run : runs) {
    Head& head = heads_.emplace_back();
    head.scan = file->scan(run.begin, run.end);
    head.number = heads_.size();
  }
}

bool RunMerge::is_after(const Head& a, const Head& b) const {
  if (a.prefix != b.prefix) return a.prefix > b.prefix;
  const auto order = order_.compare_further(a.tuple, b.tuple);
  return order != 0 ? order > 0 : a.number > b.number;
}

/// False at the end of the run.
Result<bool> RunMerge::advance(Head& head) const {
  A3D_ASSIGN(TuplePtr tuple, head.scan->next());
  if (tuple == nullptr) return false;
  A3D_ASSIGN(head.tuple, order_.keyed(std::move(tuple)));
  head.prefix = order_.prefix(head.tuple);
  return true;
}

Status RunMerge::start() {
  std::vector<Head> filled;
  for (Head& head : heads_) {
    A3D_ASSIGN(const bool has_tuple, advance(head));
    if (has_tuple) filled.push_back(std::move(head));
  }
  heads_ = std::move(filled);
  std::ranges::make_heap(heads_, [this](const Head& a, const Head& b) { return is_after(a, b); });
  return {};
}

Result<TuplePtr> RunMerge::next() {
  if (!std::exchange(has_begun_, true)) A3D_TRY(start());
  if (heads_.empty()) return TuplePtr();
  if (++steps_ % 1024 == 0) A3D_TRY(context_.check_cancelled());
  const auto after = [this](const Head& a, const Head& b) { return is_after(a, b); };
  std::ranges::pop_heap(heads_, after);
  Head& least = heads_.back();
  TuplePtr result = std::move(least.tuple.tuple());
  A3D_ASSIGN(const bool has_tuple, advance(least));
  if (has_tuple)
    std::ranges::push_heap(heads_, after);
  else
    heads_.pop_back();
  return result;
}

}  // namespace queries
