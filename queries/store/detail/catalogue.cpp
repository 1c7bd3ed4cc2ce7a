#include "queries/store/detail/catalogue.h"

#include <algorithm>
#include <array>
#include <functional>

#include "base/error_subject.h"
#include "base/propagate.h"
#include "queries/store/detail/sqlite_error.h"
#include "queries/store/detail/tables.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Status;
using algebra3d::TypeExpr;

// Without the checksum. Version 1 has no derived objects and with them not the last column.
constexpr std::size_t kColumns = 13;
constexpr std::size_t kColumnsOfVersion1 = 12;

// The cells refer to `type`, the text of the entry's type.
std::vector<Cell> row_of(const CatalogueEntry& entry, const std::string& type, std::int64_t version) {
  std::vector<Cell> row = {Cell::of(entry.id),
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
                           Cell::of(as_signed(entry.value_sum)),
                           Cell::text(entry.derived_text)};
  if (version == 1) row.resize(kColumnsOfVersion1);
  return row;
}

Error corrupt(const SqliteConnection& connection, std::string_view what) {
  return Error{ErrorCode::database_corrupt, std::string(what)}.about(connection.file());
}

// SQLite's own words name no table.
Error in_catalogue(Error error) {
  error.message += " (in the catalogue of objects)";
  return error;
}

/// A result of SQLite, whose errors then say that the catalogue was read, unless damage is only listed.
template <typename T>
Result<T> of_catalogue(Result<T> result, bool is_tolerant) {
  if (!result && !is_tolerant) return in_catalogue(std::move(result).error());
  return result;
}

Result<TypeExpr> type_from(std::string_view text) {
  A3D_ASSIGN(const algebra3d::NestedList list, algebra3d::NestedList::parse(text));
  return TypeExpr::from_nested(list);
}

Result<CatalogueEntry> entry_from(const SqliteConnection& connection, const SqliteStatement& statement,
                                  std::size_t column_count) {
  std::vector<Cell> row(column_count);
  for (std::size_t i = 0; i < column_count; ++i) row[i] = statement.column(static_cast<int>(i));
  const std::string name(row[1].bytes);
  const Cell checksum = statement.column(static_cast<int>(column_count));
  if (!checksum.is(Cell::Kind::integer) || as_unsigned(checksum.integer) != checksum_of(row))
    return corrupt(connection, "the catalogue's row of the object '" + ascii_text(name) + "' is not what was written");
  auto type = type_from(row[2].bytes);
  if (!type) return corrupt(connection, "the catalogue: the type of the object '" + name + "': " + type.error().text());
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
                        as_unsigned(row[11].integer),
                        column_count == kColumns ? std::string(row[12].bytes) : std::string()};
}

std::uint64_t checksum_of_entry(const CatalogueEntry& entry, std::int64_t version) {
  const std::string type = entry.type.text();
  return checksum_of(row_of(entry, type, version));
}

std::uint64_t type_checksum(std::string_view name, std::string_view type) {
  const std::array cells = {Cell::text(name), Cell::text(type)};
  return checksum_of(cells);
}

}  // namespace

Status Catalogue::load() {
  if (is_loaded_) return {};
  forget();
  Status status = is_tolerant_ ? read_readable() : read_all();
  if (!status) forget();
  is_loaded_ = status.ok();
  return status;
}

void Catalogue::remember_damage(const Error& error) {
  std::string text = algebra3d::without_subject(error, connection_.file()).text();
  if (std::ranges::find(damage_, text) == damage_.end()) damage_.push_back(std::move(text));
}

// From both ends, so that rows behind a damaged page are found too.
Status Catalogue::read_readable() {
  damage_.clear();
  const auto version = connection_.integer("PRAGMA user_version");
  version_ = version ? *version : kDatabaseVersion;
  for (const auto& read : std::initializer_list<std::function<Status()>>{
           [&] { return version ? check_version() : Status(version.error()); }, [&] { return read_entries(false); },
           [&] { return damage_.empty() ? Status() : read_entries(true); },
           [&] { return version_ > 1 ? read_types() : Status(); }, [&] { return check_sum(); }}) {
    Status status = read();
    if (status) continue;
    if (status.error().code == ErrorCode::interrupted) return status;
    remember_damage(status.error());
  }
  return {};
}

// Another process may have upgraded the file since it was opened, also one with a newer program.
Status Catalogue::read_all() {
  A3D_ASSIGN(version_, connection_.integer("PRAGMA user_version"));
  if (version_ < 1) return corrupt(connection_, fmt::format("there is no version {} of databases", version_));
  if (version_ > kDatabaseVersion)
    return Error{ErrorCode::database_version,
                 "the database has version {}, this program reads versions up to {}; use a newer algebra3d", version_,
                 kDatabaseVersion}
        .about(connection_.file());
  A3D_TRY(check_version());
  Status status = read_entries();
  if (status && version_ > 1) status = read_types();
  if (status) status = check_sum();
  return status;
}

// An upgrade would add tables that are there.
Status Catalogue::check_version() {
  for (const auto& [table, first_version] : {std::pair(kIndexPagesTable, kFirstVersionWithIndexPages),
                                             std::pair(kRowGroupsTable, kFirstVersionWithRowGroups)}) {
    if (version_ >= first_version) continue;
    A3D_ASSIGN(const std::int64_t count,
               connection_.integer(fmt::format("SELECT count(*) FROM sqlite_schema WHERE name = '{}'", table)));
    if (count == 0) continue;
    return corrupt(connection_, fmt::format("the header says that the database has version {}, but it has the table "
                                            "{}, which came with version {}; the header was changed",
                                            version_, table, first_version));
  }
  return {};
}

Status Catalogue::read_entries(bool backwards) {
  const std::size_t column_count = version_ == 1 ? kColumnsOfVersion1 : kColumns;
  A3D_ASSIGN(SqliteStatement rows,
             of_catalogue(connection_.use(
                              fmt::format("SELECT id, name, type, has_value, function_text, table_number, "
                                          "tuple_count, next_tuple, tuple_sum, index_relation, index_attribute, "
                                          "value_sum, {}checksum FROM catalogue NOT INDEXED{}",
                                          version_ == 1 ? "" : "derived_text, ", backwards ? " ORDER BY id DESC" : "")),
                          is_tolerant_));
  while (true) {
    A3D_ASSIGN(const bool has_row, of_catalogue(rows.step(), is_tolerant_));
    if (!has_row) return {};
    auto entry = entry_from(connection_, rows, column_count);
    if (!entry && !is_tolerant_) return std::move(entry).error();
    if (entry) {
      std::string name = entry->name;
      entries_.emplace(std::move(name), *std::move(entry));
    } else {
      remember_damage(entry.error());
    }
  }
}

Status Catalogue::read_types() {
  A3D_ASSIGN(SqliteStatement rows,
             of_catalogue(connection_.use("SELECT name, type, checksum FROM named_types NOT INDEXED"), is_tolerant_));
  while (true) {
    A3D_ASSIGN(const bool has_row, of_catalogue(rows.step(), is_tolerant_));
    if (!has_row) return {};
    const Cell name = rows.column(0);
    const Cell text = rows.column(1);
    const Cell checksum = rows.column(2);
    if (!checksum.is(Cell::Kind::integer) || as_unsigned(checksum.integer) != type_checksum(name.bytes, text.bytes))
      return corrupt(connection_, fmt::format("the catalogue's row of the type '{}' is not what was written",
                                              ascii_text(name.bytes)));
    auto type = type_from(text.bytes);
    if (!type) return corrupt(connection_, fmt::format("the type '{}': {}", name.bytes, type.error().text()));
    types_.insert_or_assign(std::string(name.bytes), *std::move(type));
  }
}

Status Catalogue::check_sum() {
  A3D_ASSIGN(SqliteStatement meta,
             of_catalogue(connection_.use("SELECT next_number, object_count, object_sum FROM meta WHERE id = 1"),
                          is_tolerant_));
  A3D_ASSIGN(const bool has_meta, of_catalogue(meta.step(), is_tolerant_));
  if (!has_meta) return corrupt(connection_, "the table meta is empty");
  next_number_ = meta.column(0).integer;
  const std::uint64_t count = as_unsigned(meta.column(1).integer);
  if (count == entries_.size() + types_.size() && as_unsigned(meta.column(2).integer) == sum()) return {};
  return corrupt(connection_, "the catalogue is not what was written: objects are missing or there are too many");
}

// The next number is part of the sum, so that a wrong one does not give a number twice.
std::uint64_t Catalogue::sum() const {
  std::uint64_t total = as_unsigned(next_number_);
  for (const auto& [name, entry] : entries_) total += checksum_of_entry(entry, version_);
  for (const auto& [name, type] : types_) total += type_checksum(name, type.text());
  return total;
}

Status Catalogue::upgrade() {
  A3D_TRY(load());
  if (version_ >= kLastVersionWithoutPageSums) return {};
  if (version_ == 1) A3D_TRY(upgrade_from_version1());
  A3D_TRY(connection_.execute(kCreateIndexPages));
  A3D_TRY(connection_.execute(fmt::format("PRAGMA user_version = {}", kLastVersionWithoutPageSums)));
  version_ = kLastVersionWithoutPageSums;
  return flush();
}

Status Catalogue::add_row_groups() {
  if (version_ >= kFirstVersionWithRowGroups) return {};
  for (const char* sql : {kCreateRowGroups, kCreateColumnChunks}) A3D_TRY(connection_.execute(sql));
  A3D_TRY(connection_.execute(fmt::format("PRAGMA user_version = {}", kFirstVersionWithRowGroups)));
  version_ = kFirstVersionWithRowGroups;
  return {};
}

Status Catalogue::upgrade_from_version1() {
  A3D_TRY(connection_.execute("DROP TABLE catalogue"));
  for (const char* sql : {kCreateCatalogue, kCreateNamedTypes, kCreateAbandoned}) A3D_TRY(connection_.execute(sql));
  for (const auto& [name, entry] : entries_) edited_.insert(name);
  is_changed_ = true;
  return {};
}

void Catalogue::forget() {
  entries_.clear();
  types_.clear();
  edited_.clear();
  removed_.clear();
  edited_types_.clear();
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

CatalogueEntry& Catalogue::rename(const std::string& from, const std::string& to) {
  is_changed_ = true;
  auto node = entries_.extract(from);
  edited_.erase(from);
  edited_.insert(to);
  node.key() = to;
  node.mapped().name = to;
  return entries_.insert(std::move(node)).position->second;
}

void Catalogue::remove(const std::string& name) {
  const auto found = entries_.find(name);
  if (found == entries_.end()) return;
  is_changed_ = true;
  removed_.insert(found->second.id);
  edited_.erase(name);
  entries_.erase(found);
}

void Catalogue::set_type(const std::string& name, TypeExpr type) {
  is_changed_ = true;
  edited_types_.insert(name);
  types_.insert_or_assign(name, std::move(type));
}

void Catalogue::remove_type(const std::string& name) {
  is_changed_ = true;
  edited_types_.insert(name);
  types_.erase(name);
}

Status Catalogue::write(const CatalogueEntry& entry) {
  A3D_ASSIGN(SqliteStatement statement,
             connection_.use("INSERT OR REPLACE INTO catalogue VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"));
  const std::string type = entry.type.text();
  const std::vector<Cell> row = row_of(entry, type, version_);
  for (std::size_t i = 0; i < row.size(); ++i) statement.bind(static_cast<int>(i) + 1, row[i]);
  statement.bind(static_cast<int>(row.size()) + 1, as_signed(checksum_of(row)));
  return statement.run();
}

Status Catalogue::write_type(const std::string& name) {
  const auto found = types_.find(name);
  if (found == types_.end()) {
    A3D_ASSIGN(SqliteStatement statement, connection_.use("DELETE FROM named_types WHERE name = ?"));
    return statement.bind(1, std::string_view(name)).run();
  }
  A3D_ASSIGN(SqliteStatement statement, connection_.use("INSERT OR REPLACE INTO named_types VALUES(?, ?, ?)"));
  const std::string text = found->second.text();
  statement.bind(1, std::string_view(name)).bind(2, std::string_view(text));
  return statement.bind(3, as_signed(type_checksum(name, text))).run();
}

Status Catalogue::write_meta() {
  A3D_ASSIGN(SqliteStatement statement, connection_.use("INSERT OR REPLACE INTO meta VALUES(1, ?, ?, ?)"));
  const auto count = static_cast<std::int64_t>(entries_.size() + types_.size());
  return statement.bind(1, next_number_).bind(2, count).bind(3, as_signed(sum())).run();
}

// Two objects may have exchanged their names: a row that gives way to another one's name is written again itself.
Status Catalogue::flush() {
  if (!is_changed_) return {};
  if (!connection_.in_transaction())
    return Error{ErrorCode::internal, "the catalogue would be written outside of a transaction"}.about(
        connection_.file());
  for (const std::int64_t id : removed_) {
    A3D_ASSIGN(SqliteStatement statement, connection_.use("DELETE FROM catalogue WHERE id = ?"));
    A3D_TRY(statement.bind(1, id).run());
  }
  for (const std::string& name : edited_) A3D_TRY(write(entries_.at(name)));
  for (const std::string& name : edited_types_) A3D_TRY(write_type(name));
  A3D_TRY(write_meta());
  removed_.clear();
  edited_.clear();
  edited_types_.clear();
  is_changed_ = false;
  return {};
}

}  // namespace queries
