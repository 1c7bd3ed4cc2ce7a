#include "queries/streams/hash_table.h"

#include <bit>
#include <iterator>
#include <utility>

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

bool SeenKeys::is_seen(std::size_t hash, const std::vector<Value>& keys) const {
  if (buckets_.empty()) return false;
  const auto is_same = [&](std::size_t entry) {
    for (std::size_t i = 0; i < keys.size(); ++i)
      if (compare(values_[entry * keys.size() + i], keys[i]) != 0) return false;
    return true;
  };
  for (std::uint32_t i = buckets_[hash & (buckets_.size() - 1)]; i != kNone; i = entries_[i].next)
    if (entries_[i].hash == hash && is_same(i)) return true;
  return false;
}

void SeenKeys::link(std::size_t entry) {
  std::uint32_t& first = buckets_[entries_[entry].hash & (buckets_.size() - 1)];
  entries_[entry].next = std::exchange(first, static_cast<std::uint32_t>(entry));
}

SeenKeys::Answer SeenKeys::add(std::vector<Value> keys) {
  std::size_t code = 0;
  // Vectors that grow leave as much unused as they use, at most.
  std::size_t bytes = 2 * (sizeof(Entry) + sizeof(std::uint32_t) + keys.size() * sizeof(Value));
  for (const Value& key : keys) {
    code = algebra3d::combine_hashes(code, hash(key));
    bytes += algebra3d::heap_bytes(key);
  }
  if (is_seen(code, keys)) return Answer::was_seen;
  is_full_ = is_full_ || entries_.size() + 1 == kNone || (!account_.take(bytes) && !entries_.empty());
  if (is_full_) return Answer::no_room;
  entries_.push_back({code, kNone});
  values_.insert(values_.end(), std::make_move_iterator(keys.begin()), std::make_move_iterator(keys.end()));
  if (entries_.size() <= buckets_.size()) {
    link(entries_.size() - 1);
  } else {
    buckets_.assign(std::bit_ceil(2 * entries_.size()), kNone);
    for (std::size_t i = 0; i < entries_.size(); ++i) link(i);
  }
  return Answer::is_new;
}

void SeenKeys::clear() {
  entries_.clear();
  values_.clear();
  buckets_.clear();
  account_.clear();
  is_full_ = false;
}

}  // namespace queries
