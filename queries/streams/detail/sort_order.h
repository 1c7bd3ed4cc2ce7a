#pragma once

#include <cstdint>
#include <vector>

#include "queries/streams/detail/keyed_tuple.h"
#include "queries/streams/detail/sorting.h"

namespace queries {

/// A sort order by several keys, prepared for many comparisons.
class SortOrder {
 public:
  explicit SortOrder(const std::vector<SortKey>& keys);

  Result<KeyedTuple> keyed(TuplePtr tuple) const { return KeyedTuple::make(std::move(tuple), attributes_); }
  /// A prefix of the first key as a number: if it is less, the tuple comes first.
  std::uint64_t prefix(const KeyedTuple& tuple) const {
    if (attributes_.empty()) return 0;
    const std::uint64_t result = order_prefix(tuple.key(attributes_, 0));
    return is_descending_.front() ? ~result : result;
  }
  /// Compares two tuples with equal prefixes by all keys.
  std::strong_ordering compare_further(const KeyedTuple& a, const KeyedTuple& b) const;

 private:
  std::vector<std::size_t> attributes_;
  std::vector<bool> is_descending_;
};

}  // namespace queries
