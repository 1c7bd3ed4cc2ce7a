#include "queries/store/detail/value_cache.h"

#include <algorithm>
#include <iterator>

#include "base/memory_limit.h"

namespace queries {

std::optional<algebra3d::Value> ValueCache::find(const ValuePlace& place) {
  const auto found = places_.find(place);
  if (found == places_.end()) return std::nullopt;
  keep(found->second, kept_.entries.begin());
  return found->second->value;
}

/// Moves an entry to those that are kept, before another one of them.
void ValueCache::keep(Entries::iterator entry, Entries::iterator before) {
  Order& from = entry->is_kept ? kept_ : new_;
  from.bytes -= entry->bytes;
  kept_.bytes += entry->bytes;
  entry->is_kept = true;
  kept_.entries.splice(before, from.entries, entry);
}

std::vector<algebra3d::Value> ValueCache::add(const ValuePlace& place, const algebra3d::Value& value,
                                              std::uint64_t bytes) {
  if (places_.contains(place)) return {};
  new_.entries.push_front({place, value, bytes});
  places_.emplace(place, new_.entries.begin());
  new_.bytes += bytes;
  return shrink();
}

std::uint64_t ValueCache::limit() const {
  return std::min<std::uint64_t>(limit_, (bytes() + algebra3d::memory_left()) / 3);
}

// The newest value stays in any case.
std::vector<algebra3d::Value> ValueCache::shrink() {
  std::vector<algebra3d::Value> left;
  const std::uint64_t limit = this->limit();
  while (bytes() > limit && places_.size() > 1) {
    const bool has_older_new = new_.entries.size() > 1;
    if (has_older_new && (new_.bytes > limit / 4 || kept_.entries.empty())) {
      // While little is kept, the first values fill the cache.
      const bool has_room = kept_.bytes + new_.entries.back().bytes <= limit - limit / 4;
      if (has_room || ++unasked_count_ % kPromoted == 0) {
        keep(std::prev(new_.entries.end()), has_room ? kept_.entries.end() : kept_.entries.begin());
        continue;
      }
    }
    Order& shrinking = has_older_new && new_.bytes > limit / 4 ? new_ : kept_.entries.empty() ? new_ : kept_;
    const auto oldest = places_.find(shrinking.entries.back().place);
    left.push_back(std::move(oldest->second->value));
    erase(oldest, std::next(oldest));
  }
  return left;
}

void ValueCache::erase(Places::iterator first, Places::iterator last) {
  for (auto place = first; place != last; ++place) {
    Order& order = place->second->is_kept ? kept_ : new_;
    order.bytes -= place->second->bytes;
    order.entries.erase(place->second);
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
  places_.clear();
  new_ = {};
  kept_ = {};
}

}  // namespace queries
