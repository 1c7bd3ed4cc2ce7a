#include "queries/store/detail/row_groups.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <utility>

#include "algebra3d/values/types/binary_io.h"
#include "base/memory_limit.h"
#include "base/propagate.h"

namespace queries {

using algebra3d::ByteReader;
using algebra3d::ByteWriter;
using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Status;

namespace {

/// Chunks that are kept for single tuples.
constexpr std::size_t kKeptBytes = std::size_t{32} << 20;

std::uint64_t chunk_seed(std::int64_t table_number, std::size_t attribute, std::int64_t first) {
  return checksum_of(
      std::array{Cell::of(table_number), Cell::of(static_cast<std::int64_t>(attribute)), Cell::of(first)});
}

std::string tuples_text(std::int64_t first, std::int64_t last) {
  return fmt::format("tuples {} to {}", first, last);
}

/// The fields of a row of row_groups, as bytes.
struct GroupBytes {
  std::string ids;
  std::string columns;
};

GroupBytes bytes_of(const GroupContent& content) {
  GroupBytes bytes;
  ByteWriter ids(bytes.ids);
  for (const std::uint32_t offset : content.offsets) ids.u32(offset);
  ByteWriter columns(bytes.columns);
  for (const GroupContent::Column& column : content.columns) {
    columns.u64(column.checksum);
    columns.u8(column.range.is_known ? 1 : 0);
    columns.u64(column.range.least);
    columns.u64(column.range.greatest);
  }
  return bytes;
}

std::uint64_t content_sum(std::int64_t table_number, const GroupContent& content, const GroupBytes& bytes) {
  return checksum_of(std::array{Cell::of(table_number), Cell::of(content.first), Cell::of(content.last),
                                Cell::of(std::int64_t{content.count}), Cell::blob(bytes.ids),
                                Cell::blob(bytes.columns)});
}

std::uint64_t group_sum(std::uint64_t content_sum, const std::shared_ptr<const std::string>& dead) {
  return checksum_of(dead != nullptr ? std::string_view(*dead) : std::string_view(), content_sum);
}

std::uint32_t bit_count(std::string_view bytes) {
  std::uint32_t count = 0;
  for (const char byte : bytes) count += static_cast<std::uint32_t>(std::popcount(static_cast<std::uint8_t>(byte)));
  return count;
}

Error damaged_group(std::int64_t first, std::int64_t last) {
  return {ErrorCode::database_corrupt, "the row group of {} is not what was written", tuples_text(first, last)};
}

/// A row of row_groups: first, last, count, ids, dead, columns, checksum.
Result<RowGroup> group_from(const RelationLayout& layout, const SqliteStatement& row) {
  std::array<Cell, 7> cells;
  row.read_columns(cells);
  const auto& [first, last, count, ids, dead, columns, checksum] = cells;
  const Error damaged = damaged_group(first.integer, last.integer);
  const bool has_kinds = first.is(Cell::Kind::integer) && last.is(Cell::Kind::integer) &&
                         count.is(Cell::Kind::integer) && ids.is(Cell::Kind::blob) && dead.is(Cell::Kind::blob) &&
                         columns.is(Cell::Kind::blob) && checksum.is(Cell::Kind::integer);
  if (!has_kinds || count.integer < 1 || count.integer > INT32_MAX) return damaged;
  auto content = std::make_shared<GroupContent>();
  content->first = first.integer;
  content->last = last.integer;
  content->count = static_cast<std::uint32_t>(count.integer);
  ByteReader id_reader(ids.bytes, "row group");
  if (!ids.bytes.empty() && ids.bytes.size() != std::size_t{4} * content->count) return damaged;
  for (std::size_t i = 0; i < ids.bytes.size() / 4; ++i) content->offsets.push_back(id_reader.u32());
  ByteReader reader(columns.bytes, "row group");
  for (std::size_t i = 0; i < layout.attributes().size(); ++i) {
    GroupContent::Column& column = content->columns.emplace_back();
    column.checksum = reader.u64();
    column.range.is_known = reader.u8() != 0;
    column.range.least = reader.u64();
    column.range.greatest = reader.u64();
  }
  RowGroup group;
  if (!dead.bytes.empty()) group.dead = std::make_shared<const std::string>(dead.bytes);
  group.dead_count = bit_count(dead.bytes);
  group.content_sum =
      content_sum(layout.table_number(), *content, {std::string(ids.bytes), std::string(columns.bytes)});
  group.checksum = group_sum(group.content_sum, group.dead);
  const bool is_right =
      reader.finish().ok() && group.checksum == as_unsigned(checksum.integer) &&
      content->id(content->count - 1) == content->last && std::ranges::is_sorted(content->offsets, std::less_equal()) &&
      (dead.bytes.empty() || dead.bytes.size() == (content->count + 7) / 8) && group.dead_count <= content->count;
  if (!is_right) return damaged;
  group.content = std::move(content);
  return group;
}

constexpr const char* kReadGroups =
    "SELECT first, last, count, ids, dead, columns, checksum FROM row_groups WHERE relation = ? ORDER BY first";

}  // namespace

std::optional<std::size_t> GroupContent::row_of(std::int64_t id) const {
  if (id < first || id > last) return std::nullopt;
  const auto offset = static_cast<std::uint64_t>(id - first);
  if (offsets.empty()) return static_cast<std::size_t>(offset);
  const auto found = std::ranges::lower_bound(offsets, offset);
  if (found == offsets.end() || *found != offset) return std::nullopt;
  return static_cast<std::size_t>(found - offsets.begin());
}

std::optional<GroupRow> GroupList::place(std::int64_t id) const {
  const auto behind =
      std::ranges::upper_bound(groups_, id, {}, [](const RowGroup& group) { return group.content->first; });
  if (behind == groups_.begin()) return std::nullopt;
  const auto index = static_cast<std::size_t>(behind - groups_.begin() - 1);
  const auto row = groups_[index].content->row_of(id);
  return row ? std::optional(GroupRow{index, *row}) : std::nullopt;
}

std::optional<GroupRow> GroupList::find(std::int64_t id) const {
  auto found = place(id);
  if (found && groups_[found->group].is_dead(found->row)) found.reset();
  return found;
}

std::uint64_t GroupList::sum() const {
  std::uint64_t sum = 0;
  for (const RowGroup& group : groups_) sum += group.checksum;
  return sum;
}

Result<RowGroups::Table*> RowGroups::table(const RelationLayout& layout) {
  const auto known = tables_.find(layout.table_number());
  if (known != tables_.end()) return &known->second;
  auto list = std::make_shared<GroupList>();
  if (layout.has_columns() && has_tables()) {
    A3D_ASSIGN(SqliteStatement rows, connection_.use(kReadGroups));
    rows.bind(1, layout.table_number());
    while (true) {
      A3D_ASSIGN(const bool has_row, rows.step());
      if (!has_row) break;
      auto group = group_from(layout, rows);
      if (!group) return std::move(group).error().about(layout.relation());
      if (group->content->first <= list->last())
        return Error{ErrorCode::database_corrupt, "the row groups overlap at tuple {}", group->content->first}.about(
            layout.relation());
      list->groups_.push_back(*std::move(group));
    }
  }
  return &tables_.emplace(layout.table_number(), Table{std::move(list), {}}).first->second;
}

Result<GroupListPtr> RowGroups::list(const RelationLayout& layout) {
  A3D_ASSIGN(const Table* own, table(layout));
  return GroupListPtr(own->list);
}

/// The list for changing: a copy if a reader has it.
GroupList& RowGroups::own_list(Table& table) {
  if (table.list.use_count() > 1) table.list = std::make_shared<GroupList>(*table.list);
  return *table.list;
}

/// The bytes of a chunk, which its group has by their checksum.
Result<std::string> RowGroups::chunk_bytes(const RelationLayout& layout, const GroupContent& group,
                                           std::size_t attribute) {
  const std::uint64_t checksum = group.columns[attribute].checksum;
  const auto unwritten = unwritten_.find({layout.table_number(), group.first, attribute});
  if (unwritten != unwritten_.end()) {
    const auto found = std::ranges::find(unwritten->second, checksum, &Unwritten::checksum);
    if (found != unwritten->second.end()) return *found->bytes;
  }
  A3D_ASSIGN(SqliteStatement statement,
             connection_.use("SELECT bytes FROM column_chunks WHERE relation = ? AND attribute = ? AND first = ?"));
  statement.bind(1, layout.table_number()).bind(2, static_cast<std::int64_t>(attribute)).bind(3, group.first);
  A3D_ASSIGN(const bool has_row, statement.step());
  if (!has_row) return Error{ErrorCode::database_corrupt, "the column chunk is not there"};
  const Cell bytes = statement.column(0);
  const std::uint64_t seed = chunk_seed(layout.table_number(), attribute, group.first);
  if (bytes.is(Cell::Kind::blob) && checksum_of(bytes.bytes, seed) == checksum) return std::string(bytes.bytes);
  return Error{ErrorCode::database_corrupt, "the column chunk is not what was written"};
}

Result<std::shared_ptr<const ColumnChunk>> RowGroups::read(const RelationLayout& layout, const GroupContent& group,
                                                           std::size_t attribute) {
  const AttributeColumns& columns = layout.attributes()[attribute];
  const auto about = [&](Error error) {
    return std::move(error)
        .about(fmt::format("'{}' of {}", columns.name, tuples_text(group.first, group.last)))
        .about(layout.relation());
  };
  auto bytes = chunk_bytes(layout, group, attribute);
  if (!bytes) return about(bytes.error());
  auto chunk = ColumnChunk::parse(columns, *std::move(bytes), group.count);
  if (!chunk) return about(chunk.error());
  return chunk;
}

Result<std::shared_ptr<const ColumnChunk>> RowGroups::kept(const RelationLayout& layout, const GroupContent& group,
                                                           std::size_t attribute) {
  const ChunkKey key{layout.table_number(), group.first, attribute};
  const auto found = kept_places_.find(key);
  if (found != kept_places_.end()) {
    if (found->second->checksum == group.columns[attribute].checksum) {
      kept_.splice(kept_.begin(), kept_, found->second);
      return found->second->chunk;
    }
    kept_bytes_ -= found->second->chunk->heap_bytes();
    kept_.erase(found->second);
    kept_places_.erase(found);
  }
  A3D_ASSIGN(auto chunk, read(layout, group, attribute));
  kept_.push_front({key, group.columns[attribute].checksum, chunk});
  kept_places_.emplace(key, kept_.begin());
  kept_bytes_ += chunk->heap_bytes();
  shrink_kept();
  return chunk;
}

// The latest stays in any case.
void RowGroups::shrink_kept() {
  const std::size_t limit = std::min(kKeptBytes, (kept_bytes_ + algebra3d::memory_left()) / 3);
  while (kept_bytes_ > limit && kept_.size() > 1) {
    kept_bytes_ -= kept_.back().chunk->heap_bytes();
    kept_places_.erase(kept_.back().key);
    kept_.pop_back();
  }
}

Result<RowGroup> RowGroups::write(const RelationLayout& layout, std::span<const std::int64_t> ids,
                                  std::span<const EncodedChunk> chunks) {
  A3D_TRY(catalogue_.add_row_groups());
  A3D_TRY(table(layout));  // the list of before is read now, when the new group is not yet in the file
  auto content = std::make_shared<GroupContent>();
  content->first = ids.front();
  content->last = ids.back();
  content->count = static_cast<std::uint32_t>(ids.size());
  if (content->last - content->first >= static_cast<std::int64_t>(ids.size()))
    for (const std::int64_t id : ids) content->offsets.push_back(static_cast<std::uint32_t>(id - content->first));
  for (std::size_t attribute = 0; attribute < chunks.size(); ++attribute) {
    const EncodedChunk& chunk = chunks[attribute];
    const std::uint64_t seed = chunk_seed(layout.table_number(), attribute, content->first);
    content->columns.push_back({checksum_of(std::string_view(chunk.bytes), seed), chunk.range});
    A3D_ASSIGN(SqliteStatement statement, connection_.use("INSERT INTO column_chunks VALUES(?, ?, ?, ?)"));
    statement.bind(1, layout.table_number()).bind(2, static_cast<std::int64_t>(attribute)).bind(3, content->first);
    A3D_TRY(statement.bind(4, Cell::blob(chunk.bytes)).run());
  }
  const GroupBytes bytes = bytes_of(*content);
  RowGroup group;
  group.content_sum = content_sum(layout.table_number(), *content, bytes);
  group.checksum = group_sum(group.content_sum, nullptr);
  A3D_ASSIGN(SqliteStatement statement, connection_.use("INSERT INTO row_groups VALUES(?, ?, ?, ?, ?, ?, ?, ?)"));
  statement.bind(1, layout.table_number()).bind(2, content->first).bind(3, content->last);
  statement.bind(4, std::int64_t{content->count}).bind(5, Cell::blob(bytes.ids)).bind(6, Cell::blob({}));
  A3D_TRY(statement.bind(7, Cell::blob(bytes.columns)).bind(8, as_signed(group.checksum)).run());
  group.content = std::move(content);
  return group;
}

Status RowGroups::append(const RelationLayout& layout, std::vector<RowGroup> groups) {
  A3D_ASSIGN(Table * own, table(layout));
  std::vector<RowGroup>& all = own_list(*own).groups_;
  for (RowGroup& group : groups) all.push_back(std::move(group));
  return {};
}

Result<std::uint64_t> RowGroups::mark_dead(const RelationLayout& layout, std::size_t index,
                                           std::span<const std::uint32_t> rows) {
  A3D_ASSIGN(Table * own, table(layout));
  RowGroup& group = own_list(*own).groups_[index];
  auto dead = group.dead != nullptr ? std::make_shared<std::string>(*group.dead)
                                    : std::make_shared<std::string>((group.content->count + 7) / 8, '\0');
  for (const std::uint32_t row : rows) {
    char& byte = (*dead)[row / 8];
    byte = static_cast<char>(byte | (1 << (row % 8)));
  }
  group.dead_count = bit_count(*dead);
  group.dead = std::move(dead);
  const std::uint64_t before = group.checksum;
  group.checksum = group_sum(group.content_sum, group.dead);
  own->changed.insert_or_assign(group.content->first, index);
  return group.checksum - before;
}

Status RowGroups::write_chunk(const ChunkKey& key, std::string_view bytes) {
  A3D_ASSIGN(SqliteStatement statement,
             connection_.use("UPDATE column_chunks SET bytes = ? WHERE relation = ? AND attribute = ? AND first = ?"));
  statement.bind(1, Cell::blob(bytes)).bind(2, key.table_number).bind(3, static_cast<std::int64_t>(key.attribute));
  return statement.bind(4, key.first).run();
}

// Readers of the chunks of before have the content of the group, in a list of their own.
Result<std::uint64_t> RowGroups::rewrite(const RelationLayout& layout, std::size_t index,
                                         std::vector<NewChunk> chunks) {
  A3D_ASSIGN(Table * own, table(layout));
  RowGroup& group = own_list(*own).groups_[index];
  const bool is_read = group.content.use_count() > 1;
  auto content = std::make_shared<GroupContent>(*group.content);
  for (NewChunk& each : chunks) {
    const std::uint64_t seed = chunk_seed(layout.table_number(), each.attribute, content->first);
    const std::uint64_t checksum = checksum_of(std::string_view(each.chunk.bytes), seed);
    content->columns[each.attribute] = {checksum, each.chunk.range};
    const ChunkKey key{layout.table_number(), content->first, each.attribute};
    if (is_read || unwritten_.contains(key))
      unwritten_[key].push_back({checksum, std::make_shared<const std::string>(std::move(each.chunk.bytes))});
    else
      A3D_TRY(write_chunk(key, each.chunk.bytes));
  }
  group.content_sum = content_sum(layout.table_number(), *content, bytes_of(*content));
  group.content = std::move(content);
  const std::uint64_t before = group.checksum;
  group.checksum = group_sum(group.content_sum, group.dead);
  own->changed.insert_or_assign(group.content->first, index);
  return group.checksum - before;
}

Status RowGroups::replace(const RelationLayout& layout, std::vector<RowGroup> groups) {
  A3D_ASSIGN(Table * own, table(layout));
  assert(own->changed.empty());
  own->list = std::make_shared<GroupList>(std::move(groups));
  return {};
}

Status RowGroups::erase(const RelationLayout& layout, const RowGroup& group) {
  for (std::size_t attribute = 0; attribute < group.content->columns.size(); ++attribute) {
    A3D_ASSIGN(SqliteStatement statement,
               connection_.use("DELETE FROM column_chunks WHERE relation = ? AND attribute = ? AND first = ?"));
    statement.bind(1, layout.table_number()).bind(2, static_cast<std::int64_t>(attribute));
    A3D_TRY(statement.bind(3, group.content->first).run());
  }
  A3D_ASSIGN(SqliteStatement statement, connection_.use("DELETE FROM row_groups WHERE relation = ? AND first = ?"));
  return statement.bind(1, layout.table_number()).bind(2, group.content->first).run();
}

Status RowGroups::erase_all(std::int64_t table_number) {
  forget(table_number);
  if (!has_tables()) return {};
  for (const char* sql :
       {"DELETE FROM column_chunks WHERE relation = ?", "DELETE FROM row_groups WHERE relation = ?"}) {
    A3D_ASSIGN(SqliteStatement statement, connection_.use(sql));
    A3D_TRY(statement.bind(1, table_number).run());
  }
  return {};
}

Status RowGroups::flush() {
  for (const auto& [key, versions] : std::exchange(unwritten_, {})) A3D_TRY(write_chunk(key, *versions.back().bytes));
  for (auto& [number, table] : tables_) {
    for (const auto& [first, index] : table.changed) {
      const RowGroup& group = (*table.list)[index];
      A3D_ASSIGN(SqliteStatement statement,
                 connection_.use("UPDATE row_groups SET dead = ?, columns = ?, checksum = ? WHERE relation = ? AND "
                                 "first = ?"));
      const GroupBytes bytes = bytes_of(*group.content);
      statement.bind(1, Cell::blob(group.dead != nullptr ? std::string_view(*group.dead) : std::string_view()));
      statement.bind(2, Cell::blob(bytes.columns)).bind(3, as_signed(group.checksum));
      A3D_TRY(statement.bind(4, number).bind(5, first).run());
    }
    table.changed.clear();
  }
  return {};
}

std::vector<std::int64_t> RowGroups::changed_tables() const {
  std::vector<std::int64_t> numbers;
  for (const auto& [number, table] : tables_)
    if (!table.changed.empty()) numbers.push_back(number);
  return numbers;
}

void RowGroups::forget() {
  tables_.clear();
  unwritten_.clear();
  kept_.clear();
  kept_places_.clear();
  kept_bytes_ = 0;
}

void RowGroups::forget(std::int64_t table_number) {
  tables_.erase(table_number);
  unwritten_.erase(unwritten_.lower_bound({table_number, INT64_MIN, 0}),
                   unwritten_.lower_bound({table_number + 1, INT64_MIN, 0}));
  for (auto kept = kept_places_.lower_bound({table_number, INT64_MIN, 0});
       kept != kept_places_.end() && kept->first.table_number == table_number;) {
    kept_bytes_ -= kept->second->chunk->heap_bytes();
    kept_.erase(kept->second);
    kept = kept_places_.erase(kept);
  }
}

Result<RowGroups::Audit> RowGroups::audit(const RelationLayout& layout) {
  Audit audit;
  if (!layout.has_columns() || !has_tables()) return audit;
  A3D_ASSIGN(SqliteStatement rows, connection_.use(kReadGroups));
  rows.bind(1, layout.table_number());
  std::int64_t last = 0;
  while (true) {
    A3D_ASSIGN(const bool has_row, rows.step());
    if (!has_row) return audit;
    auto group = group_from(layout, rows);
    if (group && group->content->first <= last) group = damaged_group(group->content->first, group->content->last);
    if (!group) {
      audit.faults.push_back(group.error());
      continue;
    }
    last = group->content->last;
    audit.groups.push_back(*std::move(group));
  }
}

}  // namespace queries
