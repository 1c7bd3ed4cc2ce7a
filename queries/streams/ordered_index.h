#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "queries/streams/datum.h"
#include "queries/streams/index_object.h"

namespace queries {

/// The entries of an ordered index, in memory or in the database: pairs of a key and a tuple id. A key may have several
/// tuples, in ascending order of ids. Keys have one type and are defined and loaded. Errors: those of reading the
/// database.
class OrderedEntries {
 public:
  virtual ~OrderedEntries() = default;
  OrderedEntries() = default;
  OrderedEntries(const OrderedEntries&) = default;
  OrderedEntries& operator=(const OrderedEntries&) = default;

  virtual Result<std::size_t> size() const = 0;
  /// Ids of the keys from `low` to `high`, both included, in the order of keys, then ids. A missing bound is infinite.
  virtual Result<std::vector<TupleId>> range(const std::optional<Value>& low,
                                             const std::optional<Value>& high) const = 0;
};

/// Ordered entries in memory. A copy is independent.
class OrderedTree final : public OrderedEntries {
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

  Result<std::size_t> size() const override { return entries_.size(); }
  Result<std::vector<TupleId>> range(const std::optional<Value>& low, const std::optional<Value>& high) const override;
  /// All entries in their order.
  std::vector<Entry> entries() const { return {entries_.begin(), entries_.end()}; }

 private:
  struct Less {
    bool operator()(const Entry& a, const Entry& b) const;
  };
  std::set<Entry, Less> entries_;
};

/// Ordered entries that are made when they are first asked for.
class DeferredOrder final : public OrderedEntries {
 public:
  using Make = std::function<Result<std::shared_ptr<const OrderedEntries>>()>;
  explicit DeferredOrder(Make make) : make_(std::move(make)) {}

  Result<std::size_t> size() const override;
  Result<std::vector<TupleId>> range(const std::optional<Value>& low, const std::optional<Value>& high) const override;

 private:
  Result<const OrderedEntries*> made() const;

  Make make_;
  mutable std::shared_ptr<const OrderedEntries> made_;
};

/// A btree object: an index on the values of one attribute in order.
class OrderedIndex : public IndexObject {
 public:
  /// A definition.
  OrderedIndex(std::string relation, std::string attribute, std::shared_ptr<const OrderedEntries> entries)
      : IndexObject(std::move(relation), std::move(attribute)), entries_(std::move(entries)) {}
  /// A frozen copy.
  OrderedIndex(std::string attribute, std::shared_ptr<const OrderedTree> tree)
      : IndexObject({}, std::move(attribute)), entries_(tree), frozen_(std::move(tree)) {}

  const OrderedEntries& entries() const { return *entries_; }
  Result<std::size_t> size() const { return entries_->size(); }
  /// Of a frozen copy.
  const OrderedTree& frozen() const { return *frozen_; }

 private:
  std::shared_ptr<const OrderedEntries> entries_;
  std::shared_ptr<const OrderedTree> frozen_;
};

}  // namespace queries
