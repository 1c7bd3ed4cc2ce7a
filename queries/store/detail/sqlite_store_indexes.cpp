// The parts of the store that deal with indexes.
#include <vector>

#include "base/propagate.h"
#include "queries/store/detail/frozen_index.h"
#include "queries/store/detail/frozen_order.h"
#include "queries/store/detail/index_pages.h"
#include "queries/store/detail/sqlite_store.h"
#include "queries/store/detail/stored_object.h"
#include "queries/store/detail/stored_order.h"
#include "queries/store/detail/stored_tree.h"

namespace queries {
namespace {

Result<std::string> frozen(const SpatialIndex& index) {
  return index.ask(encode_tree);
}

Result<std::string> frozen(const OrderedIndex& index) {
  return encode_order(index.frozen());
}

}  // namespace

template <typename Index>
Status SqliteStore::assign_index(CatalogueEntry& entry, const Index& index) {
  A3D_TRY(drop_stored_index(entry));
  entry.index_relation.clear();
  entry.index_attribute = index.attribute();
  if (!index.is_definition()) {
    A3D_ASSIGN(const std::string bytes, frozen(index));
    return write_object_bytes(*database_, entry, bytes);
  }
  const CatalogueEntry* const relation = database_->catalogue().find(index.relation());
  if (relation == nullptr || !relation->type.is_relation())
    return Error{ErrorCode::unknown_name, "{}: there is no relation '{}' for the index", entry.name, index.relation()};
  entry.index_relation = index.relation();
  entry.has_value = true;
  return make_stored_index(entry, *relation);
}

template Status SqliteStore::assign_index(CatalogueEntry& entry, const SpatialIndex& index);
template Status SqliteStore::assign_index(CatalogueEntry& entry, const OrderedIndex& index);

Status SqliteStore::make_stored_index(const CatalogueEntry& index, const CatalogueEntry& relation) {
  A3D_ASSIGN(const auto layout, database_->layout_of(relation));
  const std::size_t attribute = layout->find(index.index_attribute);
  if (index.type.is("rtree3")) {
    A3D_ASSIGN(const IndexPlace place, spatial_place(relation, index.index_attribute));
    A3D_TRY(spatial_tree(database_, place.layout, place.attribute));
    return {};
  }
  if (attribute == layout->attributes().size() || !layout->attributes()[attribute].has_native_order()) return {};
  A3D_ASSIGN(const bool is_there, has_stored_order(database_->connection(), *layout, attribute));
  return is_there ? Status() : database_->connection().execute(layout->create_order_sql(attribute));
}

// Several objects may be the same index. With its relation an ordered index goes at the end of the statement.
Status SqliteStore::drop_stored_index(const CatalogueEntry& index) {
  if (index.index_relation.empty()) return {};
  const CatalogueEntry* const relation = database_->catalogue().find(index.index_relation);
  if (index.type.is("rtree3")) {
    const auto place = relation != nullptr ? spatial_place(*relation, index.index_attribute) : Result<IndexPlace>({});
    if (place && place->layout != nullptr)
      database_->indexes().forget({place->layout->table_number(), place->attribute});
    // Pages that cannot be erased belong to no object, as `check database` says; unless SQLite has undone everything.
    Status status = erase_index_pages(database_->connection(), index.id);
    return database_->connection().in_transaction() ? Status() : status;
  }
  if (!index.type.is("btree") || relation == nullptr || relation->table_number == 0) return {};
  for (const auto& [name, other] : database_->catalogue().entries())
    if (other.id != index.id && other.type.is("btree") && other.index_relation == index.index_relation &&
        other.index_attribute == index.index_attribute)
      return {};
  A3D_ASSIGN(const auto layout, database_->layout_of(*relation));
  const std::size_t attribute = layout->find(index.index_attribute);
  if (attribute == layout->attributes().size()) return {};
  database_->indexes().drop_ordered(layout->table_number(), attribute);
  return database_->connection().execute(layout->drop_order_sql(attribute));
}

Status SqliteStore::make_stored_indexes(const CatalogueEntry& relation) {
  for (const auto& [name, index] : database_->catalogue().entries())
    if (index.index_relation == relation.name) A3D_TRY(make_stored_index(index, relation));
  return {};
}

Result<const CatalogueEntry*> SqliteStore::indexed_relation(const CatalogueEntry& index) {
  const CatalogueEntry* const relation = database_->catalogue().find(index.index_relation);
  if (relation != nullptr && relation->type.is_relation()) return relation;
  return Error{ErrorCode::database_corrupt, "{}: the index is on the relation '{}', which is not there", index.name,
               index.index_relation};
}

Result<Datum> SqliteStore::read_index(const CatalogueEntry& entry) {
  if (entry.index_relation.empty()) {
    A3D_ASSIGN(const std::string bytes, read_object_bytes(*database_, entry));
    auto tree = decode_tree(bytes);
    if (!tree) return Error{tree.error().code, "{}: {}", entry.name, tree.error().message};
    return Datum{std::make_shared<SpatialIndex>("", entry.index_attribute, *std::move(tree))};
  }
  A3D_ASSIGN(const CatalogueEntry* relation, indexed_relation(entry));
  A3D_ASSIGN(const IndexPlace place, spatial_place(*relation, entry.index_attribute));
  SpatialIndex::Source source;
  source.tree = [database = database_, place] { return spatial_tree(database, place.layout, place.attribute); };
  source.remade_tree = [database = database_, place] { return tree_of_rows(database, place.layout, place.attribute); };
  return Datum{std::make_shared<SpatialIndex>(entry.index_relation, entry.index_attribute, std::move(source))};
}

Result<Datum> SqliteStore::read_ordered_index(const CatalogueEntry& entry) {
  if (entry.index_relation.empty()) {
    const algebra3d::Type* const key_type = ordered_key_type(database_->registry(), entry.type);
    if (key_type == nullptr)
      return Error{ErrorCode::database_corrupt, "{}: the type {} is not known", entry.name, entry.type.text()};
    A3D_ASSIGN(const std::string bytes, read_object_bytes(*database_, entry));
    auto tree = decode_order(*key_type, bytes);
    if (!tree) return Error{tree.error().code, "{}: {}", entry.name, tree.error().message};
    return Datum{std::make_shared<OrderedIndex>(entry.index_attribute, *std::move(tree))};
  }
  A3D_ASSIGN(const CatalogueEntry* relation, indexed_relation(entry));
  A3D_ASSIGN(auto entries, ordered_entries_of(*relation, entry.index_attribute));
  return Datum{std::make_shared<OrderedIndex>(entry.index_relation, entry.index_attribute, std::move(entries))};
}

Result<IndexPlace> SqliteStore::spatial_place(const CatalogueEntry& relation, const std::string& attribute) {
  A3D_ASSIGN(const auto layout, database_->layout_of(relation));
  const std::size_t position = layout->find(attribute);
  if (position == layout->attributes().size() || !layout->attributes()[position].has_box())
    return Error{ErrorCode::database_corrupt, "{}: there is no spatial attribute '{}' for an index", relation.name,
                 attribute};
  return IndexPlace{layout, position};
}

Result<std::shared_ptr<const OrderedEntries>> SqliteStore::ordered_entries_of(const CatalogueEntry& relation,
                                                                              const std::string& attribute) {
  A3D_ASSIGN(const auto layout, database_->layout_of(relation));
  const std::size_t position = layout->find(attribute);
  if (position == layout->attributes().size())
    return Error{ErrorCode::database_corrupt, "{}: there is no attribute '{}' for an index", relation.name, attribute};
  return ordered_entries(database_, layout, position);
}

}  // namespace queries
