#include "queries/streams/sorting.h"

#include <algorithm>
#include <numeric>

#include "queries/streams/tuple_buffer.h"

namespace queries {
namespace {

/// A tuple with its key values at hand, loaded.
struct KeyedTuple {
  std::vector<Value> keys;
  TuplePtr tuple;
};

bool is_before(const std::vector<SortKey>& order, const KeyedTuple& a, const KeyedTuple& b) {
  for (std::size_t i = 0; i < order.size(); ++i)
    if (const auto result = compare(a.keys[i], b.keys[i]); result != 0) return (result < 0) != order[i].is_descending;
  return false;
}

}  // namespace

std::vector<SortKey> ascending(const std::vector<std::size_t>& attributes) {
  std::vector<SortKey> order;
  order.reserve(attributes.size());
  for (const std::size_t attribute : attributes) order.push_back({attribute, false});
  return order;
}

std::vector<std::size_t> all_attributes(const TypeExpr& tuple) {
  std::vector<std::size_t> attributes(tuple.attributes().size());
  std::iota(attributes.begin(), attributes.end(), std::size_t{0});
  return attributes;
}

Result<std::vector<Value>> loaded_keys(const Tuple& tuple, const std::vector<std::size_t>& attributes) {
  std::vector<Value> keys;
  keys.reserve(attributes.size());
  for (const std::size_t attribute : attributes) {
    ASSIGN_OR_RETURN(Value key, tuple.attributes[attribute].loaded());
    keys.push_back(std::move(key));
  }
  return keys;
}

std::strong_ordering compare_keys(const std::vector<Value>& a, const std::vector<Value>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (const auto order = compare(a[i], b[i]); order != 0) return order;
  return std::strong_ordering::equal;
}

Result<TupleStreamPtr> sorted(TupleStream& tuples, const std::vector<SortKey>& order, const Context& context) {
  std::vector<std::size_t> attributes;
  attributes.reserve(order.size());
  for (const SortKey& key : order) attributes.push_back(key.attribute);
  std::vector<KeyedTuple> keyed;
  RETURN_IF_ERROR(for_each_tuple(tuples, context, [&](const TuplePtr& tuple) -> Status {
    ASSIGN_OR_RETURN(auto keys, loaded_keys(*tuple, attributes));
    keyed.push_back({std::move(keys), tuple});
    return {};
  }));
  std::ranges::stable_sort(keyed, [&](const auto& a, const auto& b) { return is_before(order, a, b); });
  TupleBuffer result;
  for (KeyedTuple& entry : keyed) RETURN_IF_ERROR(result.add(std::move(entry.tuple)));
  return result.scan();
}

}  // namespace queries
