// The part of the integrity check that reads row groups and key tables.
#include <algorithm>

#include "base/propagate.h"
#include "queries/store/detail/integrity_check.h"
#include "queries/store/detail/integrity_walk.h"

namespace queries {

void KeySum::add(TupleId id, const Cell& key) {
  ++count;
  sum += checksum_of(std::array{Cell::of(id), key});
}

/// Every group, every chunk and every value in it; and that no tuple stands in a group and beside it.
Status IntegrityCheck::check_groups(Walk& walk) {
  const auto audit = database_->row_groups().audit(*walk.layout);
  if (!audit) {
    walk.are_rows_sound = false;
    return add({.object = walk.entry.name, .message = "the row groups cannot be read: "}, audit.error());
  }
  for (const Error& fault : audit->faults) {
    walk.are_rows_sound = false;
    A3D_TRY(add({.object = walk.entry.name}, fault));
  }
  for (const RowGroup& group : audit->groups) {
    A3D_TRY(check_group(walk, group));
    A3D_TRY(check_beside(walk, group));
  }
  std::ranges::sort(walk.gaps, {}, &Walk::Gap::first);
  return {};
}

Status IntegrityCheck::check_group(Walk& walk, const RowGroup& group) {
  const GroupContent& content = *group.content;
  std::vector<std::shared_ptr<const ColumnChunk>> chunks;
  for (std::size_t attribute = 0; attribute < walk.layout->attributes().size(); ++attribute) {
    const auto chunk = database_->row_groups().read(*walk.layout, content, attribute);
    const Status status = chunk ? (*chunk)->audit(content.columns[attribute].range) : Status(chunk.error());
    if (status) {
      chunks.push_back(*chunk);
      continue;
    }
    Finding damaged{.object = walk.entry.name, .attribute = walk.layout->attributes()[attribute].name};
    if (chunk) damaged.message = fmt::format("tuples {} to {}: ", content.first, content.last);
    A3D_TRY(add(std::move(damaged), status.error()));
  }
  walk.last = std::max(walk.last, content.last);
  if (chunks.size() < walk.layout->attributes().size()) {
    walk.gaps.push_back({content.first, content.last});
    return {};
  }
  walk.count += group.live_count();
  walk.sum += group.checksum;
  for (std::size_t row = 0; row < content.count; ++row) {
    if (group.is_dead(row)) continue;
    A3D_TRY(advance(walk.entry.name));
    A3D_TRY(walk_values(walk, content.id(row), [&](std::size_t attribute) { return chunks[attribute]->value(row); }));
  }
  return {};
}

/// What the indexes of the relation are to have of a tuple.
Status IntegrityCheck::walk_values(Walk& walk, TupleId id, const std::function<Result<Value>(std::size_t)>& value_of) {
  for (auto& [attribute, boxes] : walk.boxes) {
    A3D_ASSIGN(const Value value, value_of(attribute));
    if (!value.is_defined()) continue;
    if (const auto box = value.header().box; !box.is_empty()) boxes.push_back({box, static_cast<std::uint64_t>(id)});
  }
  for (auto& [attribute, keys] : walk.keys) {
    A3D_ASSIGN(const Value value, value_of(attribute));
    if (value.is_defined()) keys.push_back({value, id});
  }
  for (auto& [attribute, sum] : walk.key_sums) {
    A3D_ASSIGN(const Value value, value_of(attribute));
    sum.add(id, value.is_defined() ? native_cell(walk.layout->attributes()[attribute].form, value) : Cell());
  }
  return {};
}

Status IntegrityCheck::check_beside(Walk& walk, const RowGroup& group) {
  auto rows = database_->connection().use(walk.layout->ids_sql());
  if (!rows) return {};  // reported where the table is read
  rows->bind(1, group.content->first).bind(2, group.content->last);
  while (true) {
    const auto has_row = rows->step();
    if (!has_row || !*has_row) return {};
    const TupleId id = rows->column(0).integer;
    const auto row = group.content->row_of(id);
    if (row && group.is_dead(*row)) continue;
    walk.are_rows_sound = false;
    add({.object = walk.entry.name,
         .tuple = id,
         .message = row ? "it stands in a row group, and in the table beside it"
                        : "it stands in the table, among the tuples of a row group that does not have it"});
  }
}

// SQLite's own check has compared the index with its key table.
Status IntegrityCheck::check_key_tables(Walk& walk) {
  for (const auto& [attribute, expected] : walk.key_sums) {
    const CatalogueEntry* const index = order_definition(*walk.layout, attribute);
    const Finding place{.object = index != nullptr ? index->name : walk.entry.name,
                        .message = fmt::format("the key table {}: ", walk.layout->keys_table(attribute))};
    auto rows = database_->connection().use(
        fmt::format("SELECT id, key FROM {} NOT INDEXED", walk.layout->keys_table(attribute)));
    if (!rows) {
      A3D_TRY(add(place, rows.error()));
      continue;
    }
    KeySum found;
    while (true) {
      const auto has_row = rows->step();
      if (!has_row) A3D_TRY(add(place, has_row.error()));
      if (!has_row || !*has_row) break;
      found.add(rows->column(0).integer, rows->column(1));
    }
    if (found == expected) continue;
    Finding wrong = place;
    wrong.message += "it does not have the values of the relation";
    add(std::move(wrong));
  }
  return {};
}

/// Row groups and chunks that belong to no relation, and chunks that belong to no row group.
Status IntegrityCheck::check_group_tables() {
  if (!database_->has_row_groups()) return {};
  for (const std::string_view table : {"row_groups", "column_chunks"}) {
    const Finding where{.message = fmt::format("the table {}: ", table)};
    auto rows = database_->connection().use(fmt::format("SELECT DISTINCT relation FROM {}", table));
    if (!rows) A3D_TRY(add(where, rows.error()));
    while (rows) {
      A3D_TRY(context_.check_cancelled());
      const auto has_row = rows->step();
      if (!has_row) A3D_TRY(add(where, has_row.error()));
      if (!has_row || !*has_row) break;
      const std::int64_t number = rows->column(0).integer;
      if (!layouts_.contains(number) && !abandoned_.contains(number))
        add({.message =
                 fmt::format("the table {} has rows of the relation number {}, which is not there", table, number)});
    }
  }
  auto lone = database_->connection().use(
      "SELECT c.relation, c.attribute, c.first FROM column_chunks AS c LEFT JOIN row_groups AS g ON g.relation = "
      "c.relation AND g.first = c.first WHERE g.first IS NULL");
  if (!lone) return {};  // reported above
  while (true) {
    const auto has_row = lone->step();
    if (!has_row || !*has_row) return {};
    const auto layout = layouts_.find(lone->column(0).integer);
    if (layout == layouts_.end()) continue;
    add({.object = layout->second->relation(),
         .message = fmt::format("there is a column chunk of attribute {} from tuple {} on that belongs to no row group",
                                lone->column(1).integer, lone->column(2).integer)});
  }
}

}  // namespace queries
