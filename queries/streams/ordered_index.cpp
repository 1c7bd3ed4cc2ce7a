#include "queries/streams/ordered_index.h"

#include <algorithm>
#include <limits>

#include "base/propagate.h"

namespace queries {

bool OrderedTree::Less::operator()(const Entry& a, const Entry& b) const {
  const auto order = compare(a.key, b.key);
  return order != 0 ? order < 0 : a.id < b.id;
}

// A set that is filled in order takes linear time.
OrderedTree OrderedTree::bulk_load(std::vector<Entry> entries) {
  std::ranges::sort(entries, Less());
  OrderedTree tree;
  for (Entry& entry : entries) tree.entries_.insert(tree.entries_.end(), std::move(entry));
  return tree;
}

Result<std::vector<TupleId>> OrderedTree::range(const std::optional<Value>& low,
                                                const std::optional<Value>& high) const {
  std::vector<TupleId> ids;
  auto entry = low ? entries_.lower_bound({*low, std::numeric_limits<TupleId>::min()}) : entries_.begin();
  for (; entry != entries_.end() && (!high || compare(entry->key, *high) <= 0); ++entry) ids.push_back(entry->id);
  return ids;
}

Result<const OrderedEntries*> DeferredOrder::made() const {
  if (made_ == nullptr) {
    A3D_ASSIGN(made_, make_());
  }
  return made_.get();
}

Result<std::size_t> DeferredOrder::size() const {
  A3D_ASSIGN(const OrderedEntries* entries, made());
  return entries->size();
}

Result<std::vector<TupleId>> DeferredOrder::range(const std::optional<Value>& low,
                                                  const std::optional<Value>& high) const {
  A3D_ASSIGN(const OrderedEntries* entries, made());
  return entries->range(low, high);
}

}  // namespace queries
