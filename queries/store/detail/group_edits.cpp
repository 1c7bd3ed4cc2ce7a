#include "queries/store/detail/group_edits.h"

#include <algorithm>
#include <optional>

#include "base/propagate.h"
#include "queries/store/detail/key_tables.h"
#include "queries/store/detail/stored_tree.h"
#include "queries/store/detail/stored_tuples.h"

namespace queries {
namespace {

/// A row group is written anew if one in so many of its tuples changes. A tuple that is written as a row costs some
/// twenty times as much as one in a chunk, and is written again with its group later.
constexpr std::size_t kShareWritten = 64;
/// Bytes of changes that wait for others of their group.
constexpr std::size_t kMostWaiting = std::size_t{64} << 20U;

std::size_t bytes_of_rows(const ValueColumn& column, const SelectedRows& rows) {
  if (column.size() == 0) return rows.count;
  return column.visit([&]<typename Element>(const Element* values) {
    std::size_t bytes = rows.count * sizeof(Element);
    rows.for_each([&](std::size_t row) {
      if constexpr (std::is_same_v<Element, std::string>) bytes += values[row].size();
      if constexpr (std::is_same_v<Element, Value>) bytes += algebra3d::heap_bytes(values[row]);
    });
    return bytes;
  });
}

void append_rows(const ValueColumn& from, const SelectedRows& rows, ValueColumn& to) {
  const std::size_t first = to.size();
  to.grow(first + rows.count);
  if (from.size() > 0)
    from.visit([&]<typename Element>(const Element* values) {
      Element* const target = array_of<Element>(to) + first;
      for (std::size_t i = 0; i < rows.count; ++i) target[i] = values[rows[i]];
    });
  for (std::size_t i = 0; i < rows.count; ++i)
    if (!from.is_defined(rows[i])) to.set_undefined(first + i);
}

/// Puts the values of a column into these rows of another one, which are defined so far.
void scatter(const ValueColumn& from, std::span<const std::uint32_t> rows, ValueColumn& to) {
  from.visit([&]<typename Element>(const Element* values) {
    Element* const target = array_of<Element>(to);
    for (std::size_t i = 0; i < rows.size(); ++i) target[rows[i]] = values[i];
  });
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!from.is_defined(i)) to.set_undefined(rows[i]);
}

}  // namespace

/// A tuple in a row group; none: in the table.
struct GroupEdits::Marked {
  TupleId id = 0;
  std::optional<GroupRow> place;
};

GroupEdits::GroupEdits(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout,
                       CatalogueEntry& entry)
    : database_(std::move(database)), layout_(std::move(layout)), entry_(entry) {}

// The list is not kept: it would be copied, and chunks that it names would stay in the file.
Result<std::vector<GroupEdits::Marked>> GroupEdits::find(std::span<const TupleId> ids) const {
  A3D_ASSIGN(const GroupListPtr groups, database_->row_groups().list(*layout_));
  std::vector<Marked> found;
  found.reserve(ids.size());
  for (const TupleId id : ids) found.push_back({id, groups->find(id)});
  return found;
}

/// The attributes whose values are needed to change indexes in memory.
std::vector<bool> GroupEdits::indexed_attributes() const {
  std::vector<bool> indexed(layout_->attributes().size());
  for (const std::size_t attribute : database_->indexes().ordered_attributes(layout_->table_number()))
    indexed[attribute] = true;
  for (std::size_t attribute = 0; attribute < indexed.size(); ++attribute)
    if (layout_->attributes()[attribute].has_box() &&
        (database_->indexes().knows(layout_->table_number(), attribute) ||
         tree_owner(database_->catalogue(), *layout_, attribute).has_value()))
      indexed[attribute] = true;
  return indexed;
}

Status GroupEdits::erase_from_indexes(std::span<const TupleId> ids) {
  const std::vector<bool> indexed = indexed_attributes();
  const bool has_indexed = std::ranges::find(indexed, true) != indexed.end();
  A3D_ASSIGN(const std::vector<std::size_t>* key_attributes, database_->key_attributes(*layout_));
  if (!has_indexed && key_attributes->empty()) return {};
  const std::vector<std::size_t> ordered = database_->indexes().ordered_attributes(layout_->table_number());
  StoredTuples old(database_, layout_, indexed);
  std::vector<algebra3d::Box3> boxes(indexed.size());
  for (std::size_t first = 0; first < ids.size(); first += kBatchTuples) {
    const auto part = ids.subspan(first, std::min(kBatchTuples, ids.size() - first));
    A3D_ASSIGN(const Batch* const batch, old.read(part));
    for (std::size_t row = 0; row < part.size(); ++row) {
      A3D_TRY(erase_keys(*database_, *layout_, part[row]));
      for (const std::size_t attribute : ordered)
        if (const Value key = batch->columns[attribute]->value(row); key.is_defined())
          database_->indexes().erase_key(layout_->table_number(), attribute, key, part[row]);
      for (std::size_t attribute = 0; attribute < boxes.size(); ++attribute) {
        boxes[attribute] = {};
        if (!indexed[attribute] || !layout_->attributes()[attribute].has_box()) continue;
        if (const Value value = batch->columns[attribute]->value(row); value.is_defined())
          boxes[attribute] = value.header().box;
      }
      database_->indexes().erase(layout_->table_number(), part[row], boxes);
    }
  }
  return {};
}

Result<std::vector<TupleId>> GroupEdits::erase(std::span<const TupleId> ids, const algebra3d::Context& context) {
  A3D_ASSIGN(std::vector<Marked> found, find(ids));
  std::vector<TupleId> others;
  std::erase_if(found, [&](const Marked& each) {
    if (!each.place) others.push_back(each.id);
    return !each.place;
  });
  std::ranges::sort(found, {}, &Marked::id);
  std::vector<TupleId> dead;
  dead.reserve(found.size());
  for (const Marked& each : found) dead.push_back(each.id);
  A3D_TRY(context.check_cancelled());
  A3D_TRY(erase_from_indexes(dead));
  database_->note_group_tuples(layout_->table_number(), dead);
  std::vector<std::uint32_t> rows;
  for (auto begin = found.begin(); begin != found.end();) {
    const std::size_t group = begin->place->group;
    rows.clear();
    for (; begin != found.end() && begin->place->group == group; ++begin)
      rows.push_back(static_cast<std::uint32_t>(begin->place->row));
    A3D_ASSIGN(const std::uint64_t change, database_->row_groups().mark_dead(*layout_, group, rows));
    entry_.tuple_sum += change;
  }
  entry_.tuple_count -= static_cast<std::int64_t>(dead.size());
  return others;
}

/// An edit for each group that is written anew.
Result<std::map<std::size_t, GroupEdits::Edit>> GroupEdits::begin_edits(std::span<const Marked> tuples) const {
  A3D_ASSIGN(const GroupListPtr groups, database_->row_groups().list(*layout_));
  std::map<std::size_t, Edit> edits;
  for (const Marked& each : tuples)
    if (each.place) ++edits[each.place->group].awaited;
  std::erase_if(edits, [&](const auto& each) {
    return each.second.awaited * kShareWritten < (*groups)[each.first].content->count;
  });
  return edits;
}

void GroupEdits::add(const Batch& batch, const SelectedRows& rows, Edit& edit) {
  if (edit.values.empty())
    for (const ValueColumn* const column : batch.columns) edit.values.emplace_back(column->type());
  for (std::size_t attribute = 0; attribute < batch.columns.size(); ++attribute) {
    append_rows(*batch.columns[attribute], rows, edit.values[attribute]);
    edit.bytes += bytes_of_rows(*batch.columns[attribute], rows);
  }
  edit.awaited -= rows.count;
}

Status GroupEdits::update(const Update& update, const UpdateOne& update_one, const algebra3d::Context& context) {
  A3D_ASSIGN(const std::vector<Marked> found, find(update.ids));
  A3D_ASSIGN(auto edits, begin_edits(found));
  std::size_t waiting = 0;  // bytes
  std::size_t next = 0;
  BatchReader batches(update.values);
  std::vector<std::uint32_t> run;
  while (true) {
    A3D_TRY(context.check_cancelled());
    A3D_ASSIGN(const Batch* const batch, batches.next(kBatchTuples));
    if (batch == nullptr) break;
    if (batch->rows.count > found.size() - next)
      return Error{ErrorCode::internal, "more new tuples than ids"}.about(layout_->relation());
    for (std::size_t i = 0; i < batch->rows.count;) {
      const auto edit = found[next].place ? edits.find(found[next].place->group) : edits.end();
      if (edit == edits.end()) {
        A3D_TRY(update_one(found[next++].id, *tuple_of(*batch, batch->rows[i++])));
        continue;
      }
      run.clear();
      for (; i < batch->rows.count && found[next].place && found[next].place->group == edit->first; ++i, ++next) {
        run.push_back(static_cast<std::uint32_t>(batch->rows[i]));
        edit->second.rows.push_back(static_cast<std::uint32_t>(found[next].place->row));
      }
      waiting -= edit->second.bytes;
      add(*batch, {run.data(), run.size()}, edit->second);
      waiting += edit->second.bytes;
      if (edit->second.awaited > 0) continue;
      waiting -= edit->second.bytes;
      A3D_TRY(write(edit->first, edit->second, update, update_one));
      edits.erase(edit);
    }
    // Tuples that come in another order than that of the relation: a group may be written several times.
    if (waiting < kMostWaiting) continue;
    for (auto& [group, edit] : edits) {
      if (edit.rows.empty()) continue;
      A3D_TRY(write(group, edit, update, update_one));
      edit = {edit.awaited, {}, {}, 0};
    }
    waiting = 0;
  }
  if (next == found.size()) return {};
  return Error{ErrorCode::internal, "fewer new tuples than ids"}.about(layout_->relation());
}

Status GroupEdits::write(std::size_t group, const Edit& edit, const Update& update, const UpdateOne& update_one) {
  std::vector<TupleId> ids;
  std::vector<RowGroups::NewChunk> made;
  bool is_too_large = false;
  {
    A3D_ASSIGN(const GroupListPtr groups, database_->row_groups().list(*layout_));
    const GroupContent& content = *(*groups)[group].content;
    for (const std::uint32_t row : edit.rows) ids.push_back(content.id(row));
    std::vector<Chunks> chunks;
    std::size_t growth = 0;
    for (std::size_t i = 0; i < update.attributes.size(); ++i) {
      A3D_ASSIGN(Chunks chunk, new_chunk(content, update.attributes[i], edit, edit.values[i]));
      growth += chunk.made.chunk.bytes.size() - std::min(chunk.made.chunk.bytes.size(), chunk.old->heap_bytes());
      chunks.push_back(std::move(chunk));
    }
    is_too_large = growth > database_->options().group_bytes;
    for (std::size_t i = 0; i < chunks.size() && !is_too_large; ++i) {
      A3D_TRY(change_index(content, update.attributes[i], *chunks[i].old, edit, edit.values[i]));
      made.push_back(std::move(chunks[i].made));
    }
  }
  // Tuples that make a group too large come beside it, until the group is written as several.
  if (is_too_large) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      Tuple values;
      for (const ValueColumn& column : edit.values) values.attributes.push_back(column.value(i));
      A3D_TRY(update_one(ids[i], values));
    }
    return {};
  }
  // The stored trees name the state of the relation, also if no box changes.
  database_->indexes().insert(layout_->table_number(), ids.front(),
                              std::vector<algebra3d::Box3>(layout_->attributes().size()));
  std::ranges::sort(ids);
  database_->note_group_tuples(layout_->table_number(), ids);
  A3D_ASSIGN(const std::uint64_t change, database_->row_groups().rewrite(*layout_, group, std::move(made)));
  entry_.tuple_sum += change;
  return {};
}

Result<GroupEdits::Chunks> GroupEdits::new_chunk(const GroupContent& content, std::size_t attribute, const Edit& edit,
                                                 const ValueColumn& values) const {
  const AttributeColumns& columns = layout_->attributes()[attribute];
  A3D_ASSIGN(auto chunk, database_->row_groups().read(*layout_, content, attribute));
  std::vector<bool> is_changed(content.count);
  for (const std::uint32_t row : edit.rows) is_changed[row] = true;
  std::vector<RowPlace> kept;
  for (std::uint32_t row = 0; row < content.count; ++row)
    if (!is_changed[row]) kept.push_back({row, row});
  ValueColumn merged(*columns.type);
  merged.restart(content.count);
  A3D_TRY(chunk->read(kept, merged));
  scatter(values, edit.rows, merged);
  ChunkBuilder builder(columns);
  Status status = builder.add(merged, {nullptr, content.count});
  if (!status) return std::move(status).error().about(layout_->relation());
  return Chunks{std::move(chunk), {attribute, builder.encode()}};
}

/// The indexes of an attribute get the new values in place of the old ones.
Status GroupEdits::change_index(const GroupContent& content, std::size_t attribute, const ColumnChunk& chunk,
                                const Edit& edit, const ValueColumn& values) {
  A3D_ASSIGN(const std::vector<std::size_t>* key_attributes, database_->key_attributes(*layout_));
  const bool has_key_table = std::ranges::find(*key_attributes, attribute) != key_attributes->end();
  if (!has_key_table && !indexed_attributes()[attribute]) return {};
  const auto ordered = database_->indexes().ordered_attributes(layout_->table_number());
  const bool is_ordered = std::ranges::find(ordered, attribute) != ordered.end();
  const bool has_box = layout_->attributes()[attribute].has_box();
  // Equal reals may differ by the sign of zero, which the key table has.
  const bool is_real = layout_->attributes()[attribute].form == AttributeForm::real;
  std::vector<algebra3d::Box3> boxes(layout_->attributes().size());
  for (std::size_t i = 0; i < edit.rows.size(); ++i) {
    A3D_ASSIGN(const Value old_value, chunk.value(edit.rows[i]));
    A3D_ASSIGN(const Value new_value, values.value(i).loaded());
    const bool is_same = old_value.is_defined() == new_value.is_defined() && compare(old_value, new_value) == 0;
    if (is_same && !has_box && !is_real) continue;
    const TupleId id = content.id(edit.rows[i]);
    if (has_key_table) A3D_TRY(update_key(*database_, *layout_, attribute, id, new_value));
    if (is_ordered && old_value.is_defined())
      database_->indexes().erase_key(layout_->table_number(), attribute, old_value, id);
    if (is_ordered && new_value.is_defined())
      database_->indexes().insert_key(layout_->table_number(), attribute, new_value, id);
    if (!has_box) continue;
    boxes[attribute] = old_value.is_defined() ? old_value.header().box : algebra3d::Box3();
    database_->indexes().erase(layout_->table_number(), id, boxes);
    boxes[attribute] = new_value.is_defined() ? new_value.header().box : algebra3d::Box3();
    database_->indexes().insert(layout_->table_number(), id, boxes);
  }
  return {};
}

}  // namespace queries
