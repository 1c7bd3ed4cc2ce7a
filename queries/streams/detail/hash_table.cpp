#include "queries/streams/detail/hash_table.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>

#include "algebra3d/values/types/described_type.h"
#include "base/propagate.h"
#include "queries/streams/detail/sorting.h"

namespace queries {

void HashChains::link(std::size_t entry) {
  std::uint32_t& last = buckets_[bucket_of(links_[entry].hash)];
  links_[entry].before = std::exchange(last, static_cast<std::uint32_t>(entry));
}

void HashChains::add(std::size_t hash) {
  links_.push_back({hash, kNone});
  if (links_.size() <= buckets_.size()) return link(links_.size() - 1);
  buckets_.assign(std::bit_ceil(2 * links_.size()), kNone);
  for (std::size_t entry = 0; entry < links_.size(); ++entry) link(entry);
}

void HashChains::clear() {
  links_.clear();
  buckets_.clear();
}

Result<bool> HashTable::add(const TuplePtr& tuple) {
  A3D_ASSIGN(KeyedTuple keyed, KeyedTuple::make(tuple, key_));
  const Value& key = keyed.key(key_, 0);
  if (!key.is_defined()) return true;
  const bool has_room = account_.take(keyed.bytes() + HashChains::kBytesPerEntry) && !chains_.is_full();
  if (!has_room && !tuples_.empty()) return false;
  chains_.add(hash(key));
  tuples_.push_back(std::move(keyed));
  return true;
}

Status HashTable::find(const Tuple& probe, std::vector<TuplePtr>& found) const {
  const Value* key = &probe.attributes[probe_.front()];
  std::optional<Value> loaded;
  if (key->is_deferred()) {
    A3D_ASSIGN(loaded, key->loaded());
    key = &*loaded;
  }
  if (!key->is_defined()) return {};
  const auto begin = static_cast<std::ptrdiff_t>(found.size());
  for (std::uint32_t i = chains_.last(hash(*key)); i != HashChains::kNone; i = chains_.before(i))
    if (compare(tuples_[i].key(key_, 0), *key) == 0) found.push_back(tuples_[i].tuple());
  std::reverse(found.begin() + begin, found.end());
  return {};
}

std::vector<TuplePtr> HashTable::tuples() const {
  std::vector<TuplePtr> result;
  result.reserve(tuples_.size());
  for (const KeyedTuple& keyed : tuples_) result.push_back(keyed.tuple());
  return result;
}

void HashTable::clear() {
  tuples_.clear();
  chains_.clear();
  account_.clear();
}

bool SeenKeys::is_seen(std::size_t hash, const std::vector<Value>& keys) const {
  const auto is_same = [&](std::size_t list) {
    for (std::size_t i = 0; i < keys.size(); ++i)
      if (compare(values_[list * keys.size() + i], keys[i]) != 0) return false;
    return true;
  };
  for (std::uint32_t i = chains_.last(hash); i != HashChains::kNone; i = chains_.before(i))
    if (is_same(i)) return true;
  return false;
}

SeenKeys::Answer SeenKeys::add(std::vector<Value> keys) {
  std::size_t code = 0;
  // Vectors that grow leave as much unused as they use, at most.
  std::size_t bytes = HashChains::kBytesPerEntry + 2 * keys.size() * sizeof(Value);
  for (const Value& key : keys) {
    code = algebra3d::combine_hashes(code, hash(key));
    bytes += algebra3d::heap_bytes(key);
  }
  if (is_seen(code, keys)) return Answer::was_seen;
  is_full_ = is_full_ || chains_.is_full() || (!account_.take(bytes) && chains_.size() > 0);
  if (is_full_) return Answer::no_room;
  chains_.add(code);
  values_.insert(values_.end(), std::make_move_iterator(keys.begin()), std::make_move_iterator(keys.end()));
  return Answer::is_new;
}

void SeenKeys::clear() {
  chains_.clear();
  values_.clear();
  account_.clear();
  is_full_ = false;
}

}  // namespace queries
