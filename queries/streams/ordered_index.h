#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "queries/streams/datum.h"

namespace queries {

/// Keys of one type in their order, each with the id of a tuple; in memory. Entries are pairs, so that a key may have
/// several tuples; ids of one key ascend. Keys are defined and loaded. A copy is a tree of its own.
class OrderedTree {
 public:
  struct Entry {
    Value key;
    TupleId id = 0;
  };

  OrderedTree() = default;
  /// In any order. Cost: that of sorting.
  static OrderedTree bulk_load(std::vector<Entry> entries);

  /// Logarithmic. An entry that is there already, or is not there, is left alone.
  void insert(const Value& key, TupleId id) { entries_.insert({key, id}); }
  void erase(const Value& key, TupleId id) { entries_.erase({key, id}); }
  std::size_t size() const { return entries_.size(); }

  /// Ids of the keys between the bounds, these included; no bound where there is nothing. In the order of keys, then
  /// ids.
  std::vector<TupleId> range(const std::optional<Value>& low, const std::optional<Value>& high) const;
  /// All entries in their order.
  std::vector<Entry> entries() const { return {entries_.begin(), entries_.end()}; }

 private:
  struct Less {
    bool operator()(const Entry& a, const Entry& b) const;
  };
  std::set<Entry, Less> entries_;
};

/// A btree object: the values of one attribute in order, with the ids of their tuples. It is either a definition on a
/// stored relation, whose tree the store keeps up to date, or a frozen copy of a stream. Like SpatialIndex.
class OrderedIndex {
 public:
  using Tree = OrderedTree;

  /// `relation` is the name of the stored relation that the index follows; empty for a frozen copy.
  OrderedIndex(std::string relation, std::string attribute, std::shared_ptr<Tree> tree)
      : relation_(std::move(relation)), attribute_(std::move(attribute)), tree_(std::move(tree)) {}

  const std::string& relation() const { return relation_; }
  const std::string& attribute() const { return attribute_; }
  bool is_definition() const { return !relation_.empty(); }
  const Tree& tree() const { return *tree_; }
  Tree& tree() { return *tree_; }

 private:
  std::string relation_;
  std::string attribute_;
  std::shared_ptr<Tree> tree_;
};

}  // namespace queries
