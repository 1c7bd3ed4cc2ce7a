#include "queries/store/detail/compaction.h"

#include <algorithm>

#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "queries/store/detail/group_writer.h"
#include "queries/store/detail/key_tables.h"
#include "queries/store/detail/stored_rows.h"

namespace queries {
namespace {

/// Relations are compacted when one in so many tuples stands in the table in place of a dead one: what is written anew
/// is then some eight times what was changed.
constexpr std::int64_t kShareBeside = 8;
/// Of a row group one in so many is enough.
constexpr std::uint32_t kShareOfGroup = 16;

/// The compaction of one relation.
class Compaction {
 public:
  Compaction(Database& database, std::shared_ptr<const RelationLayout> layout, CatalogueEntry& entry)
      : database_(database), layout_(std::move(layout)), entry_(entry) {}

  /// `written`: how many tuples the statement has put into the table.
  Status run(std::int64_t written);

 private:
  bool is_due_outside(const Database::LooseRows& loose, std::int64_t written) const;
  bool is_due_within(const Database::LooseRows& loose) const;
  Status add_table(GroupWriter& writer, TupleId first, TupleId last);
  Status add_group(GroupWriter& writer, const RowGroup& group);
  Status take_row(GroupWriter& writer, RowReader& reader);
  Status erase_rows(TupleId first, TupleId last);
  Status append_groups(std::vector<RowGroup>& all, GroupWriter& writer);
  Status rewrite(std::vector<RowGroup>& all, const RowGroup& group);

  Database& database_;
  std::shared_ptr<const RelationLayout> layout_;
  CatalogueEntry& entry_;
  GroupListPtr groups_;
};

// A file of the version before may have all tuples of a relation in its table: they become row groups when many come.
bool Compaction::is_due_outside(const Database::LooseRows& loose, std::int64_t written) const {
  const auto most = static_cast<std::int64_t>(database_.options().loose_rows);
  if (loose.outside < std::max<std::int64_t>(most, 1)) return false;
  return !groups_->is_empty() || loose.outside <= 2 * most ||
         written >= static_cast<std::int64_t>(database_.options().least_group_rows);
}

bool Compaction::is_due_within(const Database::LooseRows& loose) const {
  const auto most = static_cast<std::int64_t>(database_.options().loose_rows);
  std::int64_t rows = 0;
  std::int64_t dead = 0;
  for (const RowGroup& group : groups_->all()) {
    if (group.live_count() == 0) return true;
    rows += group.content->count;
    dead += group.dead_count;
  }
  return loose.within > std::max(most, rows / kShareBeside) || (dead > most && dead - loose.within > rows / 2);
}

Status Compaction::run(std::int64_t written) {
  A3D_ASSIGN(groups_, database_.row_groups().list(*layout_));
  A3D_ASSIGN(const Database::LooseRows loose, database_.loose_rows(*layout_));
  const bool is_outside = is_due_outside(loose, written);
  const bool is_within = is_due_within(loose);
  if (!is_outside && !is_within) return {};
  if (is_outside) A3D_TRY(move_orders(database_, *layout_));
  std::vector<RowGroup> all;
  GroupWriter writer(database_, layout_);
  const bool has_groups = !groups_->is_empty();
  if (is_outside && has_groups) {
    A3D_TRY(add_table(writer, INT64_MIN, (*groups_)[0].content->first - 1));
    A3D_TRY(append_groups(all, writer));
  }
  for (const RowGroup& group : groups_->all()) {
    const bool has_many_dead = group.dead_count >= std::max(group.content->count / kShareOfGroup, 1U);
    if (is_within && has_many_dead)
      A3D_TRY(rewrite(all, group));
    else
      all.push_back(group);
  }
  if (is_outside) {
    A3D_TRY(add_table(writer, groups_->last() + 1, INT64_MAX));
    A3D_TRY(append_groups(all, writer));
  }
  database_.forget_loose_rows(layout_->table_number());
  return database_.row_groups().replace(*layout_, std::move(all));
}

Status Compaction::append_groups(std::vector<RowGroup>& all, GroupWriter& writer) {
  A3D_TRY(writer.close());
  for (RowGroup& group : writer.take_groups()) {
    entry_.tuple_sum += group.checksum;
    all.push_back(std::move(group));
  }
  return {};
}

Status Compaction::take_row(GroupWriter& writer, RowReader& reader) {
  A3D_ASSIGN(const TuplePtr tuple, reader.tuple());
  A3D_TRY(writer.add(tuple->id, *tuple));
  entry_.tuple_sum -= reader.checksum();
  return {};
}

Status Compaction::add_table(GroupWriter& writer, TupleId first, TupleId last) {
  std::shared_ptr<Database> shared = database_.shared_from_this();
  RowReader reader(shared, layout_, database_.changes().now());
  A3D_ASSIGN(SqliteStatement rows, database_.connection().use(layout_->range_sql()));
  rows.bind(1, first).bind(2, last);
  while (true) {
    A3D_ASSIGN(const bool has_row, rows.step());
    if (!has_row) break;
    A3D_TRY(reader.take(rows));
    A3D_TRY(take_row(writer, reader));
  }
  { const SqliteStatement done = std::move(rows); }
  return erase_rows(first, last);
}

Status Compaction::erase_rows(TupleId first, TupleId last) {
  A3D_ASSIGN(SqliteStatement statement, database_.connection().use(layout_->erase_range_sql()));
  return statement.bind(1, first).bind(2, last).run();
}

/// Adds the tuples of a group, and those that stand in the table in place of dead ones.
Status Compaction::add_group(GroupWriter& writer, const RowGroup& group) {
  const GroupContent& content = *group.content;
  std::vector<std::shared_ptr<const ColumnChunk>> chunks;
  for (std::size_t attribute = 0; attribute < layout_->attributes().size(); ++attribute) {
    A3D_ASSIGN(auto chunk, database_.row_groups().read(*layout_, content, attribute));
    chunks.push_back(std::move(chunk));
  }
  A3D_TRY(database_.row_groups().erase(*layout_, group));
  entry_.tuple_sum -= group.checksum;
  std::shared_ptr<Database> shared = database_.shared_from_this();
  RowReader reader(shared, layout_, database_.changes().now());
  A3D_ASSIGN(SqliteStatement rows, database_.connection().use(layout_->range_sql()));
  rows.bind(1, content.first).bind(2, content.last);
  A3D_ASSIGN(bool has_row, rows.step());
  Tuple tuple;
  for (std::size_t row = 0; row < content.count; ++row) {
    tuple.id = content.id(row);
    if (!group.is_dead(row)) {
      tuple.attributes.clear();
      for (const auto& chunk : chunks) {
        A3D_ASSIGN(Value value, chunk->value(row));
        tuple.attributes.push_back(std::move(value));
      }
      A3D_TRY(writer.add(tuple.id, tuple));
    } else if (has_row && rows.column(0).integer == tuple.id) {
      A3D_TRY(reader.take(rows));
      A3D_TRY(take_row(writer, reader));
      A3D_ASSIGN(has_row, rows.step());
    }
  }
  if (has_row)
    return Error{ErrorCode::database_corrupt, "the tuple {} stands beside a row group that does not have it",
                 rows.column(0).integer}
        .about(layout_->relation());
  return {};
}

Status Compaction::rewrite(std::vector<RowGroup>& all, const RowGroup& group) {
  if (algebra3d::is_interrupted()) return Error{ErrorCode::interrupted, "interrupted"};
  GroupWriter writer(database_, layout_);
  A3D_TRY(add_group(writer, group));
  A3D_TRY(erase_rows(group.content->first, group.content->last));
  return append_groups(all, writer);
}

CatalogueEntry* entry_of(Catalogue& catalogue, std::int64_t table_number) {
  for (const auto& [name, entry] : catalogue.entries())
    if (entry.type.is_relation() && entry.table_number == table_number) return catalogue.edit(name);
  return nullptr;
}

}  // namespace

Status compact_relations(Database& database) {
  std::map<std::int64_t, std::int64_t> changed = database.take_loosened();
  for (const std::int64_t table : database.row_groups().changed_tables()) changed.try_emplace(table, 0);
  A3D_TRY(database.row_groups().flush());
  for (const auto& [table, written] : changed) {
    CatalogueEntry* const entry = entry_of(database.catalogue(), table);
    if (entry == nullptr) continue;
    A3D_ASSIGN(const auto layout, database.layout_of(*entry));
    if (database.makes_row_groups(*layout)) A3D_TRY(Compaction(database, layout, *entry).run(written));
  }
  return {};
}

}  // namespace queries
