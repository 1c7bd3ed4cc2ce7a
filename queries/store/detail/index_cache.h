#pragma once

#include <compare>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "queries/streams/ordered_index.h"
#include "queries/streams/spatial_index.h"

namespace queries {

/// The trees of index definitions that are open, one per relation table and attribute: spatial trees, which are stored,
/// and ordered trees in memory. They are updated with their relation. A tree that is in use is copied before a change,
/// so that no cursor sees the change. Used by one thread.
class IndexCache {
 public:
  using Tree = SpatialIndex::Tree;
  struct Place {
    std::int64_t table_number;
    std::size_t attribute;

    friend auto operator<=>(const Place&, const Place&) = default;
  };

  /// Reads a stored tree; null if it turns out to be damaged.
  using Open = std::function<std::shared_ptr<Tree>()>;

  /// The tree, or null. Opens a stored one.
  std::shared_ptr<Tree> find(std::int64_t table_number, std::size_t attribute);
  /// True if the tree was looked for: it is known, or there is none that is up to date.
  bool knows(std::int64_t table_number, std::size_t attribute) const {
    return trees_.contains({table_number, attribute});
  }
  /// Adds a tree that is not stored.
  void add(std::int64_t table_number, std::size_t attribute, std::shared_ptr<Tree> tree);
  /// Adds a tree that is stored as it is, and opened when it is needed; null: there is none that is up to date.
  void add_stored(std::int64_t table_number, std::size_t attribute, Open open);

  /// A tree that differs from the stored one.
  struct Unstored {
    Place place;
    std::shared_ptr<Tree> tree;  ///< null if only the state of its relation has changed
    bool is_new;                 ///< not stored at all
  };
  std::vector<Unstored> unstored() const;
  void set_stored(const Place& place);
  /// Records that a tree could not be stored: it is used as it is, and stored as a whole when it has changed again.
  void set_unstorable(const Place& place);
  /// Forgets whether there is a tree.
  void forget(const Place& place) { trees_.erase(place); }
  /// True if the trees of a relation have not been opened for changes of it; they are from now on.
  bool begins_to_follow(std::int64_t table_number) { return followed_.insert(table_number).second; }

  /// Updates the trees after a tuple was inserted or erased. `boxes` holds one box per attribute, empty for attributes
  /// that are not spatial.
  void insert(std::int64_t table_number, std::int64_t tuple, std::span<const algebra3d::Box3> boxes);
  void erase(std::int64_t table_number, std::int64_t tuple, std::span<const algebra3d::Box3> boxes);

  // These do for ordered trees what those above do for spatial ones; they need the values of the attributes that
  // `ordered_attributes` lists.
  std::shared_ptr<OrderedTree> find_ordered(std::int64_t table_number, std::size_t attribute) const;
  void add_ordered(std::int64_t table_number, std::size_t attribute, std::shared_ptr<OrderedTree> tree);
  std::vector<std::size_t> ordered_attributes(std::int64_t table_number) const;
  /// `key` is defined and loaded.
  void insert_key(std::int64_t table_number, std::size_t attribute, const Value& key, TupleId tuple);
  void erase_key(std::int64_t table_number, std::size_t attribute, const Value& key, TupleId tuple);

  void drop_ordered(std::int64_t table_number, std::size_t attribute) { ordered_.erase({table_number, attribute}); }
  void drop_table(std::int64_t table_number);
  void clear();

 private:
  struct Spatial {
    std::shared_ptr<Tree> tree = nullptr;
    Open open = nullptr;  // null if the tree is open
    bool is_new = false;
    bool is_changed = false;

    bool is_known() const { return tree != nullptr || open != nullptr; }
    /// Opens the tree if it is not; false if there is none.
    bool ensure_open();
  };
  template <typename Change>
  void change(std::int64_t table_number, std::span<const algebra3d::Box3> boxes, Change apply);
  OrderedTree& own(std::int64_t table_number, std::size_t attribute);

  std::map<Place, Spatial> trees_;
  std::set<std::int64_t> followed_;
  std::map<Place, std::shared_ptr<OrderedTree>> ordered_;
};

}  // namespace queries
