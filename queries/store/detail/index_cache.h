#pragma once

#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "queries/streams/ordered_index.h"
#include "queries/streams/spatial_index.h"

namespace queries {

/// The trees of index definitions, in memory, one per relation table and attribute. They are updated with their
/// relation. A tree that is in use is copied before a change, so that no cursor sees the change. Used by one thread.
class IndexCache {
 public:
  using Tree = SpatialIndex::Tree;

  /// The tree, or null.
  std::shared_ptr<Tree> find(std::int64_t table_number, std::size_t attribute) const;
  void add(std::int64_t table_number, std::size_t attribute, std::shared_ptr<Tree> tree);

  /// Updates the trees after a tuple was inserted or erased. `boxes` holds one box per attribute, empty for attributes
  /// that are not spatial.
  void insert(std::int64_t table_number, std::int64_t tuple, std::span<const algebra3d::Box3> boxes);
  void erase(std::int64_t table_number, std::int64_t tuple, std::span<const algebra3d::Box3> boxes);

  // The same for ordered trees, which need the values of the attributes that `ordered_attributes` lists.
  std::shared_ptr<OrderedTree> find_ordered(std::int64_t table_number, std::size_t attribute) const;
  void add_ordered(std::int64_t table_number, std::size_t attribute, std::shared_ptr<OrderedTree> tree);
  std::vector<std::size_t> ordered_attributes(std::int64_t table_number) const;
  /// `key` is defined and loaded.
  void insert_key(std::int64_t table_number, std::size_t attribute, const Value& key, TupleId tuple);
  void erase_key(std::int64_t table_number, std::size_t attribute, const Value& key, TupleId tuple);

  void drop_table(std::int64_t table_number);
  void clear();

 private:
  using Key = std::pair<std::int64_t, std::size_t>;
  template <typename Change>
  void change(std::int64_t table_number, std::span<const algebra3d::Box3> boxes, Change apply);
  OrderedTree& own(std::int64_t table_number, std::size_t attribute);

  std::map<Key, std::shared_ptr<Tree>> trees_;
  std::map<Key, std::shared_ptr<OrderedTree>> ordered_;
};

}  // namespace queries
