#pragma once

#include <compare>
#include <cstdint>
#include <list>
#include <map>
#include <optional>

#include "algebra3d/types/value.h"

namespace queries {

/// The location of a large value: table of the relation, tuple and attribute.
struct ValuePlace {
  std::int64_t table_number = 0;
  std::int64_t tuple = 0;
  std::size_t attribute = 0;

  friend auto operator<=>(const ValuePlace&, const ValuePlace&) = default;
};

/// A least-recently-used cache of loaded values with a limit in bytes; it outlives statements. A change of a stored
/// value must erase it here. Used under the lock of its owner.
class ValueCache {
 public:
  explicit ValueCache(std::uint64_t limit) : limit_(limit) {}

  std::optional<algebra3d::Value> find(const ValuePlace& place);
  /// Adds `value`, which stays even if it is larger than the cache. `bytes` is an estimate.
  void add(const ValuePlace& place, const algebra3d::Value& value, std::uint64_t bytes);
  /// Removes the values of a tuple.
  void erase(std::int64_t table_number, std::int64_t tuple);
  void erase_table(std::int64_t table_number);
  void clear();

  std::uint64_t bytes() const { return bytes_; }

 private:
  struct Kept {
    ValuePlace place;
    algebra3d::Value value;
    std::uint64_t bytes;
  };
  using Order = std::list<Kept>;  // most recently used first

  void erase(std::map<ValuePlace, Order::iterator>::iterator first,
             std::map<ValuePlace, Order::iterator>::iterator last);

  std::uint64_t limit_;
  std::uint64_t bytes_ = 0;
  Order order_;
  std::map<ValuePlace, Order::iterator> places_;
};

}  // namespace queries
