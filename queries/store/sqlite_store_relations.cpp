// The parts of the store that deal with relations and the indexes on them.
#include <vector>

#include "queries/store/frozen_index.h"
#include "queries/store/relation_scan.h"
#include "queries/store/sqlite_store.h"
#include "queries/store/stored_object.h"
#include "queries/store/stored_relation.h"

namespace queries {

// The new table is filled before the old one goes: the tuples may come out of the old one. Tuple ids go on where they
// were, so that ids in frozen indexes never mean other tuples.
Status SqliteStore::assign_relation(CatalogueEntry& entry, const Datum& value, const algebra3d::Context& context) {
  const auto* relation = std::get_if<RelationPtr>(&value.content);
  const auto* stream = std::get_if<TupleStreamPtr>(&value.content);
  if (relation == nullptr && stream == nullptr)
    return Error{ErrorCode::internal, "{}: neither a relation nor a stream of tuples", entry.name};
  TupleStreamPtr tuples = stream != nullptr ? *stream : nullptr;
  if (tuples == nullptr) {
    ASSIGN_OR_RETURN(tuples, (*relation)->scan());
  }
  CatalogueEntry filled = entry;
  filled.table_number = database_->catalogue().take_number();
  filled.tuple_count = 0;
  filled.tuple_sum = 0;
  filled.has_value = true;
  ASSIGN_OR_RETURN(const auto layout, database_->layout_of(filled));
  database_->note_created(layout->table_number());
  RETURN_IF_ERROR(database_->connection().execute(layout->create_sql()));
  RETURN_IF_ERROR(fill_relation(*database_, *layout, filled, *tuples, context));
  RETURN_IF_ERROR(drop_table(entry));
  entry = std::move(filled);
  return {};
}

Status SqliteStore::drop_table(const CatalogueEntry& entry) {
  if (!entry.type.is_relation() || entry.table_number == 0) return {};
  ASSIGN_OR_RETURN(const auto layout, database_->layout_of(entry));
  database_->drop_at_end(layout);
  return {};
}

Status SqliteStore::assign_index(CatalogueEntry& entry, const SpatialIndex& index) {
  entry.index_relation.clear();
  entry.index_attribute.clear();
  if (!index.is_definition()) return write_object_bytes(*database_, entry, encode_tree(index.tree()));
  const CatalogueEntry* const relation = database_->catalogue().find(index.relation());
  if (relation == nullptr || !relation->type.is_relation())
    return Error{ErrorCode::unknown_name, "{}: there is no relation '{}' for the index", entry.name, index.relation()};
  entry.index_relation = index.relation();
  entry.index_attribute = index.attribute();
  entry.has_value = true;
  return {};
}

Result<Datum> SqliteStore::read_index(const CatalogueEntry& entry) {
  if (entry.index_relation.empty()) {
    ASSIGN_OR_RETURN(const std::string bytes, read_object_bytes(*database_, entry));
    auto tree = decode_tree(bytes);
    if (!tree) return Error{tree.error().code, "{}: {}", entry.name, tree.error().message};
    return Datum{std::make_shared<SpatialIndex>("", "", *std::move(tree))};
  }
  const CatalogueEntry* const relation = database_->catalogue().find(entry.index_relation);
  if (relation == nullptr || !relation->type.is_relation())
    return Error{ErrorCode::database_corrupt, "{}: the index is on the relation '{}', which is not there", entry.name,
                 entry.index_relation};
  ASSIGN_OR_RETURN(auto tree, tree_of(*relation, entry.index_attribute));
  return Datum{std::make_shared<SpatialIndex>(entry.index_relation, entry.index_attribute, std::move(tree))};
}

Result<std::shared_ptr<SpatialIndex::Tree>> SqliteStore::tree_of(const CatalogueEntry& relation,
                                                                 const std::string& attribute) {
  ASSIGN_OR_RETURN(const auto layout, database_->layout_of(relation));
  const std::size_t position = layout->find(attribute);
  if (position == layout->attributes().size() || !layout->attributes()[position].has_box())
    return Error{ErrorCode::database_corrupt, "{}: there is no spatial attribute '{}' for an index", relation.name,
                 attribute};
  if (auto known = database_->indexes().find(relation.table_number, position)) return known;
  RelationScan scan(database_, layout);
  std::vector<rtree::Entry<std::uint64_t>> entries;
  while (true) {
    ASSIGN_OR_RETURN(const TuplePtr tuple, scan.next());
    if (tuple == nullptr) break;
    const Value& value = tuple->attributes[position];
    if (!value.is_defined()) continue;
    if (const auto box = value.header().box; !box.is_empty())
      entries.push_back({box, static_cast<std::uint64_t>(tuple->id)});
  }
  auto tree = std::make_shared<SpatialIndex::Tree>(SpatialIndex::Tree::bulk_load(entries));
  database_->indexes().add(relation.table_number, position, tree);
  return tree;
}

}  // namespace queries
