#include "queries/streams/hash_table.h"

#include <algorithm>

#include "queries/streams/sorting.h"

namespace queries {

Status HashTable::fill(TupleStream& tuples, std::size_t key, const Context& context) {
  return for_each_tuple(tuples, context, [&](const TuplePtr& tuple) -> Status {
    ASSIGN_OR_RETURN(Value value, tuple->attributes[key].loaded());
    if (!value.is_defined()) return {};
    auto& bucket = buckets_[hash(value)];
    bucket.emplace_back(std::move(value), tuple);
    return {};
  });
}

std::vector<TuplePtr> HashTable::matches(const Value& key) const {
  std::vector<TuplePtr> found;
  const auto bucket = buckets_.find(hash(key));
  if (bucket == buckets_.end()) return found;
  for (const auto& [value, tuple] : bucket->second)
    if (compare(value, key) == 0) found.push_back(tuple);
  return found;
}

bool SeenKeys::add(std::vector<Value> keys) {
  std::size_t code = 0;
  for (const Value& key : keys) code = code * 1'000'003 + hash(key);
  auto& bucket = buckets_[code];
  if (std::ranges::any_of(bucket, [&](const auto& seen) { return compare_keys(seen, keys) == 0; })) return false;
  bucket.push_back(std::move(keys));
  return true;
}

}  // namespace queries
