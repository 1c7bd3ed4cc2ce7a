#include "queries/streams/hash_table.h"

#include <bit>

#include "algebra3d/types/described_type.h"
#include "queries/streams/sorting.h"

namespace queries {

Result<bool> HashTable::add(const TuplePtr& tuple) {
  ASSIGN_OR_RETURN(KeyedTuple keyed, KeyedTuple::make(tuple, key_));
  const Value& key = keyed.key(key_, 0);
  if (!key.is_defined()) return true;
  // Up to two buckets for each entry.
  const std::size_t bytes = keyed.bytes() + sizeof(Entry) - sizeof(KeyedTuple) + 2 * sizeof(std::uint32_t);
  if (!entries_.empty() && (!account_.take(bytes) || entries_.size() + 1 == kNone)) return false;
  const std::size_t code = hash(key);
  entries_.push_back({code, kNone, std::move(keyed)});
  return true;
}

void HashTable::finish() {
  buckets_.assign(std::bit_ceil(entries_.size() + 1), kNone);
  // Backwards, since each entry is put before those of its bucket.
  for (std::size_t i = entries_.size(); i-- > 0;) {
    std::uint32_t& first = buckets_[entries_[i].hash & (buckets_.size() - 1)];
    entries_[i].next = std::exchange(first, static_cast<std::uint32_t>(i));
  }
}

Status HashTable::find(const Tuple& probe, std::vector<TuplePtr>& found) const {
  const Value* key = &probe.attributes[probe_.front()];
  std::optional<Value> loaded;
  if (key->is_deferred()) {
    ASSIGN_OR_RETURN(loaded, key->loaded());
    key = &*loaded;
  }
  if (!key->is_defined()) return {};
  const std::size_t code = hash(*key);
  for (std::uint32_t i = buckets_[code & (buckets_.size() - 1)]; i != kNone; i = entries_[i].next) {
    const Entry& entry = entries_[i];
    if (entry.hash == code && compare(entry.tuple.key(key_, 0), *key) == 0) found.push_back(entry.tuple.tuple());
  }
  return {};
}

std::vector<TuplePtr> HashTable::tuples() const {
  std::vector<TuplePtr> result;
  result.reserve(entries_.size());
  for (const Entry& entry : entries_) result.push_back(entry.tuple.tuple());
  return result;
}

void HashTable::clear() {
  entries_.clear();
  account_.clear();
}

SeenKeys::Answer SeenKeys::add(std::vector<Value> keys) {
  std::size_t code = 0;
  std::size_t bytes = sizeof(std::pair<std::size_t, std::vector<Value>>) + 4 * sizeof(void*);
  for (const Value& key : keys) {
    code = algebra3d::combine_hashes(code, hash(key));
    bytes += sizeof(Value) + algebra3d::heap_bytes(key);
  }
  const auto [first, last] = lists_.equal_range(code);
  for (auto known = first; known != last; ++known)
    if (compare_keys(known->second, keys) == 0) return Answer::was_seen;
  is_full_ = is_full_ || (!account_.take(bytes) && !lists_.empty());
  if (is_full_) return Answer::no_room;
  lists_.emplace(code, std::move(keys));
  return Answer::is_new;
}

void SeenKeys::clear() {
  lists_.clear();
  account_.clear();
  is_full_ = false;
}

}  // namespace queries
