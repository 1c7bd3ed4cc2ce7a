#include "queries/store/detail/stored_relation.h"

#include <algorithm>
#include <optional>

#include "base/propagate.h"
#include "queries/store/detail/chunks.h"
#include "queries/store/detail/group_edits.h"
#include "queries/store/detail/key_tables.h"
#include "queries/store/detail/relation_filling.h"
#include "queries/store/detail/relation_scan.h"
#include "queries/store/detail/stored_tree.h"
#include "queries/store/detail/stored_tuples.h"
#include "queries/streams/datum.h"

namespace queries {
namespace {

Error unknown_tuple(const RelationLayout& layout, TupleId id) {
  return Error{ErrorCode::unknown_name, "there is no tuple {}", id}.about(layout.relation());
}

}  // namespace

// The relation may have been replaced or removed since the statement asked for it.
Result<const CatalogueEntry*> StoredRelation::entry() const {
  A3D_TRY(database_->check_statement(statement_));
  const CatalogueEntry* const entry = database_->catalogue().find(layout_->relation());
  if (entry != nullptr && entry->table_number == layout_->table_number()) return entry;
  return Error{ErrorCode::wrong_usage, "the relation was replaced or deleted by the statement that still uses it"}
      .about(layout_->relation());
}

Result<std::int64_t> StoredRelation::count() const {
  A3D_ASSIGN(const CatalogueEntry* own, entry());
  return own->tuple_count;
}

Result<TupleStreamPtr> StoredRelation::scan() {
  A3D_TRY(entry());
  return TupleStreamPtr(std::make_shared<RelationScan>(database_, layout_));
}

Result<TupleStreamPtr> StoredRelation::scan_columns(std::vector<bool> read, std::vector<AttributeBounds> bounds) {
  A3D_TRY(entry());
  return TupleStreamPtr(std::make_shared<RelationScan>(database_, layout_, std::move(read), std::move(bounds)));
}

Result<TuplePtr> StoredRelation::fetch(TupleId id) {
  A3D_TRY(entry());
  StoredTuples tuples(database_, layout_, std::vector<bool>(layout_->attributes().size(), true));
  A3D_ASSIGN(const Batch* const found, tuples.read({&id, 1}));
  return found->rows.count == 0 ? TuplePtr() : tuple_of(*found, found->rows[0]);
}

Result<std::unique_ptr<TuplesById>> StoredRelation::by_id(std::vector<bool> read) {
  A3D_TRY(entry());
  return std::unique_ptr<TuplesById>(std::make_unique<StoredTuples>(database_, layout_, std::move(read)));
}

// Until the statement ends, the row can be read through another connection as it is now, if it has not changed before.
bool StoredRelation::keeps(TupleId id) const {
  return database_->changes().is_untouched(layout_->table_number(), id);
}

// The values that ordered indexes have of the tuple.
Result<StoredRelation::Keys> StoredRelation::keys(const std::function<Result<Value>(std::size_t)>& value_of) const {
  Keys keys;
  for (const std::size_t attribute : database_->indexes().ordered_attributes(layout_->table_number())) {
    A3D_ASSIGN(const Value value, value_of(attribute));
    if (!value.is_defined()) continue;
    A3D_ASSIGN(Value key, value.loaded());
    keys.emplace_back(attribute, std::move(key));
  }
  return keys;
}

/// A tuple in the form of a row, with its bytes, which do not change under a reader when the row is written.
struct StoredRelation::OldRow {
  std::string bytes;
  RowReader reader;
  std::optional<GroupRow> place;  ///< in a row group; none: in the table
};

Result<std::unique_ptr<StoredRelation::OldRow>> StoredRelation::read_row(TupleId id) const {
  auto row = std::make_unique<OldRow>(OldRow{{}, {database_, layout_, database_->changes().now()}, {}});
  A3D_ASSIGN(const GroupListPtr groups, database_->row_groups().list(*layout_));
  row->place = groups->find(id);
  if (row->place) {
    A3D_ASSIGN(const TuplePtr tuple,
               tuple_of_group(*database_, *layout_, (*groups)[row->place->group], row->place->row));
    A3D_ASSIGN(const auto writer, RowWriter::make(*database_, *layout_, id, *tuple));
    append_proved(writer->cells().first(layout_->small_column_count()), row->bytes);
    row->reader.take(row->bytes, writer->row().checksum);
    return row;
  }
  A3D_ASSIGN(SqliteStatement statement, database_->connection().use(layout_->fetch_sql()));
  statement.bind(1, id);
  A3D_ASSIGN(const bool has_row, statement.step());
  if (!has_row) return unknown_tuple(*layout_, id);
  std::vector<Cell> cells(layout_->small_column_count());
  statement.read_columns(cells);
  if (!append_proved(cells, row->bytes)) return damaged_row(*layout_, id);
  row->reader.take(row->bytes, as_unsigned(cells[1].integer));
  return row;
}

void StoredRelation::change_keys(const Keys& old_keys, const Keys& new_keys, TupleId id) {
  for (const auto& [attribute, key] : old_keys)
    database_->indexes().erase_key(layout_->table_number(), attribute, key, id);
  for (const auto& [attribute, key] : new_keys)
    database_->indexes().insert_key(layout_->table_number(), attribute, key, id);
}

Status StoredRelation::write(CatalogueEntry& entry, RowWriter& writer, TupleId id) {
  const auto value_of = [&](std::size_t attribute) -> Result<Value> { return writer.value(attribute); };
  A3D_ASSIGN(const Keys new_keys, keys(value_of));
  A3D_TRY(writer.write());
  A3D_TRY(insert_keys(*database_, *layout_, id, writer.values()));
  if (layout_->has_columns()) database_->note_loose(layout_->table_number(), {.outside = 1});
  change_keys({}, new_keys, id);
  ++entry.tuple_count;
  entry.tuple_sum += writer.row().checksum;
  database_->indexes().insert(layout_->table_number(), id, writer.row().boxes);
  return {};
}

/// Removes a tuple from where it stands. The checksum of its relation changes, and not the number of its tuples.
Status StoredRelation::erase_place(CatalogueEntry& entry, const OldRow& old, TupleId id) {
  if (old.place) {
    database_->note_group_tuples(layout_->table_number(), {&id, 1});
    const auto row = static_cast<std::uint32_t>(old.place->row);
    A3D_ASSIGN(const std::uint64_t change, database_->row_groups().mark_dead(*layout_, old.place->group, {&row, 1}));
    entry.tuple_sum += change;
    return {};
  }
  entry.tuple_sum -= old.reader.checksum();
  A3D_TRY(database_->note_tuple(*layout_, id));
  if (layout_->has_columns()) {
    A3D_ASSIGN(const GroupListPtr groups, database_->row_groups().list(*layout_));
    database_->note_loose(layout_->table_number(),
                          groups->holds(id) ? Database::LooseRows{.within = -1} : Database::LooseRows{.outside = -1});
  }
  A3D_ASSIGN(SqliteStatement statement, database_->connection().use(layout_->erase_sql()));
  return statement.bind(1, id).run();
}

Status StoredRelation::erase_row(CatalogueEntry& entry, TupleId id) {
  A3D_ASSIGN(const auto old, read_row(id));
  A3D_ASSIGN(const Keys old_keys, keys([&](std::size_t attribute) { return old->reader.value(attribute); }));
  change_keys(old_keys, {}, id);
  --entry.tuple_count;
  database_->indexes().erase(layout_->table_number(), id, old->reader.boxes());
  A3D_TRY(erase_keys(*database_, *layout_, id));
  A3D_TRY(erase_place(entry, *old, id));
  return erase_chunks(database_->connection(), layout_->table_number(), id);
}

Status StoredRelation::overwrite(CatalogueEntry& entry, const OldRow& old, RowWriter& writer, TupleId id) {
  A3D_ASSIGN(const Keys old_keys, keys([&](std::size_t attribute) { return old.reader.value(attribute); }));
  A3D_ASSIGN(const Keys new_keys,
             keys([&](std::size_t attribute) -> Result<Value> { return writer.value(attribute); }));
  change_keys(old_keys, new_keys, id);
  A3D_TRY(update_keys(*database_, *layout_, old.reader, writer));
  if (old.place) {
    A3D_TRY(erase_place(entry, old, id));
    database_->note_loose(layout_->table_number(), {.within = 1});
    A3D_TRY(writer.write());
    entry.tuple_sum += writer.row().checksum;
  } else {
    A3D_TRY(database_->note_tuple(*layout_, id));
    A3D_TRY(writer.overwrite());
    entry.tuple_sum += writer.row().checksum - old.reader.checksum();
  }
  std::vector<algebra3d::Box3> old_boxes = old.reader.boxes();
  std::vector<algebra3d::Box3> new_boxes = writer.row().boxes;
  for (std::size_t i = 0; i < old_boxes.size(); ++i)
    if (old_boxes[i] == new_boxes[i]) old_boxes[i] = new_boxes[i] = {};
  database_->indexes().erase(layout_->table_number(), id, old_boxes);
  database_->indexes().insert(layout_->table_number(), id, new_boxes);
  return {};
}

Result<TupleId> StoredRelation::insert(const Tuple& tuple) {
  A3D_ASSIGN(const CatalogueEntry* own, entry());
  const TupleId id = own->next_tuple;
  A3D_ASSIGN(const auto writer, RowWriter::make(*database_, *layout_, id, tuple));
  A3D_TRY(database_->change([&]() -> Status {
    follow_changes(database_, layout_);
    CatalogueEntry& edited = *database_->catalogue().edit(layout_->relation());
    ++edited.next_tuple;
    database_->note_inserted(layout_->table_number(), id);
    return write(edited, *writer, id);
  }));
  ++database_->change_counts().inserted;
  return id;
}

Status StoredRelation::erase(TupleId id) {
  A3D_TRY(entry());
  Status status = database_->change([&] {
    follow_changes(database_, layout_);
    return erase_row(*database_->catalogue().edit(layout_->relation()), id);
  });
  if (status) ++database_->change_counts().deleted;
  return status;
}

// The writer reads what the new tuple defers before the old one goes, if that is not to stay where it is.
Status StoredRelation::update(TupleId id, const Tuple& tuple) {
  A3D_TRY(entry());
  A3D_ASSIGN(const auto old, read_row(id));
  A3D_ASSIGN(const auto writer, RowWriter::make(*database_, *layout_, id, tuple, &old->reader));
  Status status = database_->change([&] {
    follow_changes(database_, layout_);
    return overwrite(*database_->catalogue().edit(layout_->relation()), *old, *writer, id);
  });
  if (status) ++database_->change_counts().updated;
  return status;
}

Status StoredRelation::erase_all(std::span<const TupleId> ids, const algebra3d::Context& context) {
  A3D_TRY(entry());
  Status status = database_->change([&]() -> Status {
    follow_changes(database_, layout_);
    CatalogueEntry& edited = *database_->catalogue().edit(layout_->relation());
    A3D_ASSIGN(const std::vector<TupleId> others, GroupEdits(database_, layout_, edited).erase(ids, context));
    for (const TupleId id : others) {
      A3D_TRY(context.check_cancelled());
      A3D_TRY(erase_row(edited, id));
    }
    return {};
  });
  if (status) database_->change_counts().deleted += ids.size();
  return status;
}

/// Gives a tuple new values of some attributes.
Status StoredRelation::update_row(TupleId id, std::span<const std::size_t> attributes, const Tuple& values) {
  A3D_ASSIGN(const TuplePtr old, fetch(id));
  if (old == nullptr) return unknown_tuple(*layout_, id);
  Tuple changed = *old;
  for (std::size_t i = 0; i < attributes.size(); ++i) changed.attributes[attributes[i]] = values.attributes[i];
  A3D_ASSIGN(const auto row, read_row(id));
  A3D_ASSIGN(const auto writer, RowWriter::make(*database_, *layout_, id, changed, &row->reader));
  return overwrite(*database_->catalogue().edit(layout_->relation()), *row, *writer, id);
}

Status StoredRelation::update_all(std::span<const TupleId> ids, std::span<const std::size_t> attributes,
                                  TupleStream& values, const algebra3d::Context& context) {
  A3D_TRY(entry());
  const auto update_one = [&](TupleId id, const Tuple& tuple) { return update_row(id, attributes, tuple); };
  Status status = database_->change([&]() -> Status {
    follow_changes(database_, layout_);
    CatalogueEntry& edited = *database_->catalogue().edit(layout_->relation());
    return GroupEdits(database_, layout_, edited).update({ids, attributes, values}, update_one, context);
  });
  if (status) database_->change_counts().updated += ids.size();
  return status;
}

/// The new tuples of a row group come into the indexes of their relation.
Status StoredRelation::index_group(const RowGroup& group) {
  const auto& attributes = layout_->attributes();
  A3D_ASSIGN(const std::vector<std::size_t>* key_attributes, database_->key_attributes(*layout_));
  bool is_indexed =
      !key_attributes->empty() || !database_->indexes().ordered_attributes(layout_->table_number()).empty();
  for (std::size_t attribute = 0; attribute < attributes.size(); ++attribute)
    is_indexed = is_indexed || (attributes[attribute].has_box() &&
                                (database_->indexes().knows(layout_->table_number(), attribute) ||
                                 tree_owner(database_->catalogue(), *layout_, attribute).has_value()));
  if (!is_indexed) return {};
  for (std::size_t row = 0; row < group.content->count; ++row) {
    A3D_ASSIGN(const TuplePtr tuple, tuple_of_group(*database_, *layout_, group, row));
    A3D_TRY(insert_keys(*database_, *layout_, tuple->id, tuple->attributes));
    A3D_ASSIGN(const Keys new_keys,
               keys([&](std::size_t attribute) -> Result<Value> { return tuple->attributes[attribute]; }));
    change_keys({}, new_keys, tuple->id);
    std::vector<algebra3d::Box3> boxes(attributes.size());
    for (std::size_t attribute = 0; attribute < attributes.size(); ++attribute)
      if (attributes[attribute].has_box() && tuple->attributes[attribute].is_defined())
        boxes[attribute] = tuple->attributes[attribute].header().box;
    database_->indexes().insert(layout_->table_number(), tuple->id, boxes);
  }
  return {};
}

Result<TupleStreamPtr> StoredRelation::insert_all(TupleStream& tuples, const algebra3d::Context& context) {
  A3D_ASSIGN(const CatalogueEntry* own, entry());
  if (!database_->makes_row_groups(*layout_)) return Relation::insert_all(tuples, context);
  const TupleId first = own->next_tuple;
  RelationFilling filling(*database_, layout_, first);
  std::vector<Tuple> left;
  Status status = database_->change([&]() -> Status {
    A3D_TRY(filling.add_all(tuples, context));
    A3D_TRY(entry());
    follow_changes(database_, layout_);
    A3D_ASSIGN(left, filling.finish(*database_->catalogue().edit(layout_->relation())));
    if (!filling.groups().empty()) database_->note_inserted(layout_->table_number(), first);
    for (const RowGroup& group : filling.groups()) {
      A3D_TRY(index_group(group));
      database_->change_counts().inserted += group.content->count;
    }
    return {};
  });
  A3D_TRY(status);
  for (const Tuple& tuple : left) A3D_TRY(insert(tuple));
  auto inserted =
      std::make_shared<RelationScan>(database_, layout_, std::vector<bool>(layout_->attributes().size(), true));
  inserted->begin_at(first);
  return TupleStreamPtr(std::move(inserted));
}

namespace {

Status fill_table(Database& database, const RelationLayout& layout, CatalogueEntry& entry, const Tuple& tuple) {
  A3D_ASSIGN(const auto writer, RowWriter::make(database, layout, entry.next_tuple, tuple));
  A3D_TRY(writer->write());
  ++entry.next_tuple;
  ++entry.tuple_count;
  entry.tuple_sum += writer->row().checksum;
  return {};
}

}  // namespace

Status fill_relation(Database& database, const std::shared_ptr<const RelationLayout>& layout, CatalogueEntry& entry,
                     TupleStream& source, const algebra3d::Context& context) {
  if (database.makes_row_groups(*layout)) {
    RelationFilling filling(database, layout, entry.next_tuple);
    A3D_TRY(filling.add_all(source, context));
    A3D_ASSIGN(const std::vector<Tuple> left, filling.finish(entry));
    for (const Tuple& tuple : left) A3D_TRY(fill_table(database, *layout, entry, tuple));
    return {};
  }
  while (true) {
    A3D_TRY(context.check_cancelled());
    A3D_ASSIGN(const TuplePtr tuple, source.next());
    if (tuple == nullptr) return {};
    A3D_TRY(fill_table(database, *layout, entry, *tuple));
  }
}

}  // namespace queries
