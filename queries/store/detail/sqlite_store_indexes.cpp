// The parts of the store that deal with indexes.
#include <functional>
#include <vector>

#include "queries/store/detail/frozen_index.h"
#include "queries/store/detail/frozen_order.h"
#include "queries/store/detail/relation_scan.h"
#include "queries/store/detail/sqlite_store.h"
#include "queries/store/detail/stored_object.h"

namespace queries {
namespace {

std::string frozen(const SpatialIndex& index) {
  return encode_tree(index.tree());
}

std::string frozen(const OrderedIndex& index) {
  return encode_order(index.tree());
}

/// All tuples of a relation, one after the other.
Status for_each_tuple(const std::shared_ptr<Database>& database, const std::shared_ptr<const RelationLayout>& layout,
                      const std::function<Status(const Tuple&)>& visit) {
  RelationScan scan(database, layout);
  while (true) {
    ALGEBRA3D_ASSIGN_OR_RETURN(const TuplePtr tuple, scan.next());
    if (tuple == nullptr) return {};
    ALGEBRA3D_RETURN_IF_ERROR(visit(*tuple));
  }
}

}  // namespace

template <typename Index>
Status SqliteStore::assign_index(CatalogueEntry& entry, const Index& index) {
  entry.index_relation.clear();
  entry.index_attribute = index.attribute();
  if (!index.is_definition()) return write_object_bytes(*database_, entry, frozen(index));
  const CatalogueEntry* const relation = database_->catalogue().find(index.relation());
  if (relation == nullptr || !relation->type.is_relation())
    return Error{ErrorCode::unknown_name, "{}: there is no relation '{}' for the index", entry.name, index.relation()};
  entry.index_relation = index.relation();
  entry.has_value = true;
  return {};
}

template Status SqliteStore::assign_index(CatalogueEntry& entry, const SpatialIndex& index);
template Status SqliteStore::assign_index(CatalogueEntry& entry, const OrderedIndex& index);

Result<const CatalogueEntry*> SqliteStore::indexed_relation(const CatalogueEntry& index) {
  const CatalogueEntry* const relation = database_->catalogue().find(index.index_relation);
  if (relation != nullptr && relation->type.is_relation()) return relation;
  return Error{ErrorCode::database_corrupt, "{}: the index is on the relation '{}', which is not there", index.name,
               index.index_relation};
}

Result<Datum> SqliteStore::read_index(const CatalogueEntry& entry) {
  if (entry.index_relation.empty()) {
    ALGEBRA3D_ASSIGN_OR_RETURN(const std::string bytes, read_object_bytes(*database_, entry));
    auto tree = decode_tree(bytes);
    if (!tree) return Error{tree.error().code, "{}: {}", entry.name, tree.error().message};
    return Datum{std::make_shared<SpatialIndex>("", entry.index_attribute, *std::move(tree))};
  }
  ALGEBRA3D_ASSIGN_OR_RETURN(const CatalogueEntry* relation, indexed_relation(entry));
  ALGEBRA3D_ASSIGN_OR_RETURN(auto tree, tree_of(*relation, entry.index_attribute));
  return Datum{std::make_shared<SpatialIndex>(entry.index_relation, entry.index_attribute, std::move(tree))};
}

Result<Datum> SqliteStore::read_ordered_index(const CatalogueEntry& entry) {
  if (entry.index_relation.empty()) {
    const algebra3d::Type* const key_type = ordered_key_type(database_->registry(), entry.type);
    if (key_type == nullptr)
      return Error{ErrorCode::database_corrupt, "{}: the type {} is not known", entry.name, entry.type.text()};
    ALGEBRA3D_ASSIGN_OR_RETURN(const std::string bytes, read_object_bytes(*database_, entry));
    auto tree = decode_order(*key_type, bytes);
    if (!tree) return Error{tree.error().code, "{}: {}", entry.name, tree.error().message};
    return Datum{std::make_shared<OrderedIndex>("", entry.index_attribute, *std::move(tree))};
  }
  ALGEBRA3D_ASSIGN_OR_RETURN(const CatalogueEntry* relation, indexed_relation(entry));
  ALGEBRA3D_ASSIGN_OR_RETURN(auto tree, ordered_tree_of(*relation, entry.index_attribute));
  return Datum{std::make_shared<OrderedIndex>(entry.index_relation, entry.index_attribute, std::move(tree))};
}

Result<std::shared_ptr<SpatialIndex::Tree>> SqliteStore::tree_of(const CatalogueEntry& relation,
                                                                 const std::string& attribute) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const auto layout, database_->layout_of(relation));
  const std::size_t position = layout->find(attribute);
  if (position == layout->attributes().size() || !layout->attributes()[position].has_box())
    return Error{ErrorCode::database_corrupt, "{}: there is no spatial attribute '{}' for an index", relation.name,
                 attribute};
  if (auto known = database_->indexes().find(relation.table_number, position)) return known;
  std::vector<rtree::Entry<std::uint64_t>> entries;
  ALGEBRA3D_RETURN_IF_ERROR(for_each_tuple(database_, layout, [&](const Tuple& tuple) -> Status {
    const Value& value = tuple.attributes[position];
    if (!value.is_defined()) return {};
    if (const auto box = value.header().box; !box.is_empty())
      entries.push_back({box, static_cast<std::uint64_t>(tuple.id)});
    return {};
  }));
  auto tree = std::make_shared<SpatialIndex::Tree>(SpatialIndex::Tree::bulk_load(entries, rtree::Filling::room_for_changes));
  database_->indexes().add(relation.table_number, position, tree);
  return tree;
}

Result<std::shared_ptr<OrderedTree>> SqliteStore::ordered_tree_of(const CatalogueEntry& relation,
                                                                  const std::string& attribute) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const auto layout, database_->layout_of(relation));
  const std::size_t position = layout->find(attribute);
  if (position == layout->attributes().size())
    return Error{ErrorCode::database_corrupt, "{}: there is no attribute '{}' for an index", relation.name, attribute};
  if (auto known = database_->indexes().find_ordered(relation.table_number, position)) return known;
  std::vector<OrderedTree::Entry> entries;
  ALGEBRA3D_RETURN_IF_ERROR(for_each_tuple(database_, layout, [&](const Tuple& tuple) -> Status {
    ALGEBRA3D_ASSIGN_OR_RETURN(Value key, tuple.attributes[position].loaded());
    if (key.is_defined()) entries.push_back({std::move(key), tuple.id});
    return {};
  }));
  auto tree = std::make_shared<OrderedTree>(OrderedTree::bulk_load(std::move(entries)));
  database_->indexes().add_ordered(relation.table_number, position, tree);
  return tree;
}

}  // namespace queries
