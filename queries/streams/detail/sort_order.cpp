#include "queries/streams/detail/sort_order.h"

namespace queries {

SortOrder::SortOrder(const std::vector<SortKey>& keys) {
  for (const SortKey& key : keys) {
    attributes_.push_back(key.attribute);
    is_descending_.push_back(key.is_descending);
  }
}

std::strong_ordering SortOrder::compare_further(const KeyedTuple& a, const KeyedTuple& b) const {
  const bool first_is_done = !attributes_.empty() && a.key(attributes_, 0).type().is_whole_in_prefix();
  for (std::size_t i = first_is_done ? 1 : 0; i < attributes_.size(); ++i) {
    const auto order = algebra3d::compare(a.key(attributes_, i), b.key(attributes_, i));
    if (order != 0) return is_descending_[i] ? 0 <=> order : order;
  }
  return std::strong_ordering::equal;
}

}  // namespace queries
