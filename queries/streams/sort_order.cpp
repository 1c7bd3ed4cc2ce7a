#include "queries/streams/sort_order.h"

namespace queries {

SortOrder::SortOrder(const std::vector<SortKey>& keys) {
  for (const SortKey& key : keys) {
    attributes_.push_back(key.attribute);
    is_descending_.push_back(key.is_descending);
  }
}

std::strong_ordering SortOrder::compare(const KeyedTuple& a, const KeyedTuple& b) const {
  for (std::size_t i = 0; i < attributes_.size(); ++i) {
    const auto order = algebra3d::compare(a.key(attributes_, i), b.key(attributes_, i));
    if (order != 0) return is_descending_[i] ? 0 <=> order : order;
  }
  return std::strong_ordering::equal;
}

}  // namespace queries
