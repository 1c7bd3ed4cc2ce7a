// The parts of the store that deal with relations.
#include "base/propagate.h"
#include "queries/store/detail/sqlite_store.h"
#include "queries/store/detail/stored_relation.h"

namespace queries {

// The new table is filled before the old one goes: the tuples may come out of the old one. Tuple ids go on where they
// were, so that ids in frozen indexes never mean other tuples.
Status SqliteStore::assign_relation(CatalogueEntry& entry, const Datum& value, const algebra3d::Context& context) {
  const auto* relation = std::get_if<RelationPtr>(&value.content);
  const auto* stream = std::get_if<TupleStreamPtr>(&value.content);
  if (relation == nullptr && stream == nullptr)
    return Error{ErrorCode::internal, "neither a relation nor a stream of tuples"}.about(entry.name);
  TupleStreamPtr tuples = stream != nullptr ? *stream : nullptr;
  if (tuples == nullptr) {
    A3D_ASSIGN(tuples, (*relation)->scan());
  }
  CatalogueEntry filled = entry;
  filled.table_number = database_->catalogue().take_number();
  filled.tuple_count = 0;
  filled.tuple_sum = 0;
  filled.has_value = true;
  A3D_ASSIGN(const auto layout, database_->layout_of(filled));
  database_->note_created(layout->table_number());
  A3D_TRY(database_->connection().execute(layout->create_sql()));
  A3D_TRY(fill_relation(*database_, layout, filled, *tuples, context));
  A3D_TRY(drop_table(entry));
  entry = std::move(filled);
  return make_stored_indexes(entry);
}

Status SqliteStore::drop_table(const CatalogueEntry& entry) {
  if (!entry.type.is_relation() || entry.table_number == 0) return {};
  A3D_ASSIGN(const auto layout, database_->layout_of(entry));
  database_->drop_at_end(layout);
  return {};
}

}  // namespace queries
