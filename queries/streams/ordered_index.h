#pragma once

#include <optional>
#include <set>
#include <vector>

#include "queries/streams/datum.h"
#include "queries/streams/index_object.h"

namespace queries {

/// An ordered set, in memory, of pairs of a key and a tuple id. A key may have several tuples, in ascending order of
/// ids. Keys have one type and are defined and loaded. A copy is independent.
class OrderedTree {
 public:
  struct Entry {
    Value key;
    TupleId id = 0;
  };

  OrderedTree() = default;
  /// Builds a tree from entries in any order. Cost: that of sorting.
  static OrderedTree bulk_load(std::vector<Entry> entries);

  /// Insertion and removal. Cost: logarithmic. Inserting an existing entry or removing a missing one does nothing.
  void insert(const Value& key, TupleId id) { entries_.insert({key, id}); }
  void erase(const Value& key, TupleId id) { entries_.erase({key, id}); }
  std::size_t size() const { return entries_.size(); }

  /// Ids of the keys from `low` to `high`, both included, in the order of keys, then ids. A missing bound is infinite.
  std::vector<TupleId> range(const std::optional<Value>& low, const std::optional<Value>& high) const;
  /// All entries in their order.
  std::vector<Entry> entries() const { return {entries_.begin(), entries_.end()}; }

 private:
  struct Less {
    bool operator()(const Entry& a, const Entry& b) const;
  };
  std::set<Entry, Less> entries_;
};

/// A btree object: an index on the values of one attribute in order.
class OrderedIndex : public IndexObject<OrderedTree> {
  using IndexObject::IndexObject;
};

}  // namespace queries
