#include "queries/store/detail/value_cache.h"

namespace queries {

std::optional<algebra3d::Value> ValueCache::find(const ValuePlace& place) {
  const auto found = places_.find(place);
  if (found == places_.end()) return std::nullopt;
  order_.splice(order_.begin(), order_, found->second);
  return found->second->value;
}

void ValueCache::add(const ValuePlace& place, const algebra3d::Value& value, std::uint64_t bytes) {
  if (places_.contains(place)) return;
  order_.push_front({place, value, bytes});
  places_.emplace(place, order_.begin());
  bytes_ += bytes;
  while (bytes_ > limit_ && order_.size() > 1) {
    const auto oldest = places_.find(order_.back().place);
    erase(oldest, std::next(oldest));
  }
}

void ValueCache::erase(std::map<ValuePlace, Order::iterator>::iterator first,
                       std::map<ValuePlace, Order::iterator>::iterator last) {
  for (auto place = first; place != last; ++place) {
    bytes_ -= place->second->bytes;
    order_.erase(place->second);
  }
  places_.erase(first, last);
}

void ValueCache::erase(std::int64_t table_number, std::int64_t tuple) {
  erase(places_.lower_bound({table_number, tuple, 0}), places_.upper_bound({table_number, tuple, SIZE_MAX}));
}

void ValueCache::erase_table(std::int64_t table_number) {
  erase(places_.lower_bound({table_number, INT64_MIN, 0}), places_.upper_bound({table_number, INT64_MAX, SIZE_MAX}));
}

void ValueCache::clear() {
  order_.clear();
  places_.clear();
  bytes_ = 0;
}

}  // namespace queries
