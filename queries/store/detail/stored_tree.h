#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "queries/store/detail/catalogue.h"
#include "queries/store/detail/index_cache.h"
#include "queries/store/detail/relation_layout.h"
#include "queries/store/detail/sqlite_connection.h"

namespace queries {

class Database;

/// The state of a relation that a stored tree has: two states with other tuples differ, but for a collision of their
/// checksums.
struct RelationState {
  std::int64_t table_number = 0;
  std::int64_t attribute = 0;
  std::int64_t tuple_count = 0;
  std::int64_t next_tuple = 0;
  std::uint64_t tuple_sum = 0;

  friend bool operator==(const RelationState&, const RelationState&) = default;
};

/// True if the pages of `owner` hold a tree of this state. Errors: database_corrupt.
algebra3d::Result<bool> has_tree(SqliteConnection& connection, std::int64_t owner, const RelationState& state);
/// The tree that the pages of `owner` hold. Its nodes are read when they are first needed, within a statement of
/// `database`. Errors: database_corrupt; database_version for a tree of another version of the program.
algebra3d::Result<std::shared_ptr<IndexCache::Tree>> load_tree(const std::shared_ptr<Database>& database,
                                                               std::int64_t owner);

/// Writes a tree that is new, or what has changed in it since it was loaded or written. For the steps of store_trees
/// and for benchmarks. Errors: those of SQLite; throws what reading the tree throws.
algebra3d::Status store_tree(SqliteConnection& connection, std::int64_t owner, const RelationState& state,
                             IndexCache::Tree& tree, bool is_new);

/// The number under which the tree of an attribute is stored, that of the first object that is an index on it; nothing
/// if there is none.
std::optional<std::int64_t> tree_owner(const Catalogue& catalogue, const RelationLayout& layout, std::size_t attribute);

RelationState relation_state(const CatalogueEntry& relation, std::size_t attribute);

/// The tree of an attribute: the one that is open, or that is stored with the present state of the relation, or else
/// one made of the rows, which is stored at the end of the statement or after it. Errors: those of reading the rows.
algebra3d::Result<std::shared_ptr<IndexCache::Tree>> spatial_tree(const std::shared_ptr<Database>& database,
                                                                  const std::shared_ptr<const RelationLayout>& layout,
                                                                  std::size_t attribute);
/// The tree of an attribute, made of the rows even if a stored tree exists.
algebra3d::Result<std::shared_ptr<IndexCache::Tree>> tree_of_rows(const std::shared_ptr<Database>& database,
                                                                  const std::shared_ptr<const RelationLayout>& layout,
                                                                  std::size_t attribute);
/// Loads the stored trees of a relation before it changes, so that they are updated with it.
void follow_changes(const std::shared_ptr<Database>& database, const std::shared_ptr<const RelationLayout>& layout);

/// Writes the trees that differ from the stored ones. One that cannot be written is not up to date in the file, and is
/// made anew when it is needed. Errors: a failure at which SQLite has rolled back the whole transaction.
algebra3d::Status store_trees(Database& database);

}  // namespace queries
