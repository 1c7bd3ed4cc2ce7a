#include "queries/store/catalogue.h"

#include <array>

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Status;
using algebra3d::TypeExpr;

constexpr std::size_t kColumns = 12;  // without the checksum
using Row = std::array<Cell, kColumns>;

// The cells refer to `type`, the text of the entry's type.
Row row_of(const CatalogueEntry& entry, const std::string& type) {
  return {Cell::of(entry.id),
          Cell::text(entry.name),
          Cell::text(type),
          Cell::of(std::int64_t{entry.has_value}),
          Cell::text(entry.function_text),
          Cell::of(entry.table_number),
          Cell::of(entry.tuple_count),
          Cell::of(entry.next_tuple),
          Cell::of(as_signed(entry.tuple_sum)),
          Cell::text(entry.index_relation),
          Cell::text(entry.index_attribute),
          Cell::of(as_signed(entry.value_sum))};
}

Error corrupt(const SqliteConnection& connection, std::string_view what) {
  return {ErrorCode::database_corrupt, "{}: {}", connection.file(), what};
}

Result<TypeExpr> type_from(std::string_view text) {
  ASSIGN_OR_RETURN(const algebra3d::NestedList list, algebra3d::NestedList::parse(text));
  return TypeExpr::from_nested(list);
}

Result<CatalogueEntry> entry_from(const SqliteConnection& connection, const SqliteStatement& statement) {
  Row row;
  for (std::size_t i = 0; i < kColumns; ++i) row[i] = statement.column(static_cast<int>(i));
  const std::string name(row[1].bytes);
  const Cell checksum = statement.column(kColumns);
  if (!checksum.is(Cell::Kind::integer) || as_unsigned(checksum.integer) != checksum_of(row))
    return corrupt(connection, "the catalogue's row of the object '" + name + "' is not what was written");
  auto type = type_from(row[2].bytes);
  if (!type) return corrupt(connection, "the type of the object '" + name + "': " + type.error().message);
  return CatalogueEntry{row[0].integer,
                        name,
                        *std::move(type),
                        row[3].integer != 0,
                        std::string(row[4].bytes),
                        row[5].integer,
                        row[6].integer,
                        row[7].integer,
                        as_unsigned(row[8].integer),
                        std::string(row[9].bytes),
                        std::string(row[10].bytes),
                        as_unsigned(row[11].integer)};
}

std::uint64_t checksum_of(const CatalogueEntry& entry) {
  const std::string type = entry.type.text();
  return checksum_of(row_of(entry, type));
}

}  // namespace

Status Catalogue::load() {
  if (is_loaded_) return {};
  forget();
  Status status = read_entries();
  if (!status) forget();
  is_loaded_ = status.ok();
  return status;
}

Status Catalogue::read_entries() {
  ASSIGN_OR_RETURN(SqliteStatement rows,
                   connection_.use("SELECT id, name, type, has_value, function_text, table_number, tuple_count, "
                                   "next_tuple, tuple_sum, index_relation, index_attribute, value_sum, checksum FROM "
                                   "catalogue NOT INDEXED"));
  while (true) {
    ASSIGN_OR_RETURN(const bool has_row, rows.step());
    if (!has_row) break;
    ASSIGN_OR_RETURN(CatalogueEntry entry, entry_from(connection_, rows));
    std::string name = entry.name;
    entries_.emplace(std::move(name), std::move(entry));
  }
  ASSIGN_OR_RETURN(SqliteStatement meta,
                   connection_.use("SELECT next_number, object_count, object_sum FROM meta WHERE id = 1"));
  ASSIGN_OR_RETURN(const bool has_meta, meta.step());
  if (!has_meta) return corrupt(connection_, "the table meta is empty");
  next_number_ = meta.column(0).integer;
  const std::uint64_t expected = as_unsigned(meta.column(2).integer);
  if (as_unsigned(meta.column(1).integer) != entries_.size() || expected != sum())
    return corrupt(connection_, "the catalogue is not what was written: objects are missing or there are too many");
  return {};
}

// The next number is part of the sum, so that a wrong one does not give a number twice.
std::uint64_t Catalogue::sum() const {
  std::uint64_t total = as_unsigned(next_number_);
  for (const auto& [name, entry] : entries_) total += checksum_of(entry);
  return total;
}

void Catalogue::forget() {
  entries_.clear();
  edited_.clear();
  removed_.clear();
  next_number_ = 1;
  is_loaded_ = is_changed_ = false;
}

const CatalogueEntry* Catalogue::find(const std::string& name) const {
  const auto found = entries_.find(name);
  return found == entries_.end() ? nullptr : &found->second;
}

CatalogueEntry& Catalogue::add(CatalogueEntry entry) {
  is_changed_ = true;
  edited_.insert(entry.name);
  std::string name = entry.name;
  return entries_.insert_or_assign(std::move(name), std::move(entry)).first->second;
}

CatalogueEntry* Catalogue::edit(const std::string& name) {
  const auto found = entries_.find(name);
  if (found == entries_.end()) return nullptr;
  is_changed_ = true;
  edited_.insert(name);
  return &found->second;
}

void Catalogue::remove(const std::string& name) {
  const auto found = entries_.find(name);
  if (found == entries_.end()) return;
  is_changed_ = true;
  removed_.insert(found->second.id);
  edited_.erase(name);
  entries_.erase(found);
}

Status Catalogue::write(const CatalogueEntry& entry) {
  ASSIGN_OR_RETURN(SqliteStatement statement,
                   connection_.use("INSERT OR REPLACE INTO catalogue VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"));
  const std::string type = entry.type.text();
  const Row row = row_of(entry, type);
  for (std::size_t i = 0; i < kColumns; ++i) statement.bind(static_cast<int>(i) + 1, row[i]);
  statement.bind(static_cast<int>(kColumns) + 1, as_signed(checksum_of(row)));
  return statement.run();
}

Status Catalogue::flush() {
  if (!is_changed_) return {};
  for (const std::int64_t id : removed_) {
    ASSIGN_OR_RETURN(SqliteStatement statement, connection_.use("DELETE FROM catalogue WHERE id = ?"));
    RETURN_IF_ERROR(statement.bind(1, id).run());
  }
  for (const std::string& name : edited_) RETURN_IF_ERROR(write(entries_.at(name)));
  ASSIGN_OR_RETURN(SqliteStatement statement, connection_.use("INSERT OR REPLACE INTO meta VALUES(1, ?, ?, ?)"));
  statement.bind(1, next_number_).bind(2, static_cast<std::int64_t>(entries_.size())).bind(3, as_signed(sum()));
  RETURN_IF_ERROR(statement.run());
  removed_.clear();
  edited_.clear();
  is_changed_ = false;
  return {};
}

}  // namespace queries
