// The part of the integrity check that looks at SQLite's pages, and at what tables and columns there are.
#include <algorithm>

#include "queries/store/integrity_check.h"
#include "queries/store/sqlite_error.h"
#include "queries/store/tables.h"

namespace queries {
namespace {

/// The tables that are there once, and how findings about them begin.
constexpr std::pair<const char*, const char*> kOwnTables[] = {
    {"meta", "the catalogue (table meta): "},
    {"catalogue", "the catalogue (table catalogue): "},
    {"named_types", "the catalogue (table named_types): "},
    {"abandoned", "the catalogue (table abandoned): "},
    {"object_values", "the table object_values, which holds the values of objects that are no relations: "},
    {"chunks", "the table chunks, which holds long values: "},
    {"imported_files", "the table imported_files, which says what was imported: "},
};

bool is_about_free_pages(std::string_view text) {
  const auto has = [text](std::string_view part) { return text.find(part) != std::string_view::npos; };
  return has("is never used") || has("reelist") || has("ist trunk") || has("reserved page") || has("ointer map");
}

Result<std::vector<std::string>> column_names(SqliteConnection& connection, const std::string& table) {
  ASSIGN_OR_RETURN(SqliteStatement rows,
                   connection.use(fmt::format("SELECT name FROM pragma_table_xinfo('{}') ORDER BY cid", table)));
  std::vector<std::string> names;
  while (true) {
    ASSIGN_OR_RETURN(const bool has_row, rows.step());
    if (!has_row) return names;
    names.emplace_back(rows.column(0).bytes);
  }
}

}  // namespace

/// All tables that belong here, each with the beginning of findings about it.
std::vector<std::pair<std::string, Finding>> IntegrityCheck::tables() {
  std::vector<std::pair<std::string, Finding>> result;
  for (const auto& [table, begin] : kOwnTables) result.emplace_back(table, Finding{.message = begin});
  for (const auto& [name, entry] : database_->catalogue().entries()) {
    if (!entry.type.is_relation() || entry.table_number == 0) continue;
    if (const auto layout = database_->layout_of(entry))
      result.emplace_back((*layout)->table(), Finding{.object = name});
  }
  return result;
}

// SQLite's check of the whole file ends at some kinds of damage, and says which tree is damaged and not whose it is. So
// if it finds anything, each table is checked alone.
Status IntegrityCheck::check_pages() {
  const std::size_t before = findings_.size();
  ASSIGN_OR_RETURN(const bool is_sound, check_pages_of("PRAGMA integrity_check", {}));
  if (is_sound) return {};
  std::vector<Finding> general(findings_.begin() + static_cast<std::ptrdiff_t>(before), findings_.end());
  findings_.resize(before);
  finding_counts_.erase("");
  for (const Finding& each : findings_) finding_counts_[each.object] += each.object.empty() ? 1 : 0;
  bool is_explained = !findings_.empty();
  for (const auto& [table, place] : tables()) {
    RETURN_IF_ERROR(context_.check_cancelled());
    ASSIGN_OR_RETURN(const bool is_whole, check_pages_of(fmt::format("PRAGMA integrity_check('{}')", table), place));
    is_explained = is_explained || !is_whole;
  }
  for (Finding& each : general) {
    if (is_about_free_pages(each.message))
      add({.message = "the free pages of the file, which hold no object: " + each.message});
    else if (!is_explained)
      add({.message = kCatalogueFinding + each.message});
  }
  return {};
}

/// Whether SQLite finds nothing.
Result<bool> IntegrityCheck::check_pages_of(std::string_view sql, const Finding& place) {
  SqliteConnection& connection = database_->connection();
  Finding finding = place;
  finding.message += "SQLite: ";
  auto statement = connection.use(sql);
  if (!statement) {
    RETURN_IF_ERROR(add(finding, statement.error()));
    return false;
  }
  connection.end_when(context_.cancel);
  bool is_sound = true;
  Status status;
  while (true) {
    const auto has_row = statement->step();
    if (!has_row) status = add(finding, has_row.error());
    is_sound = is_sound && has_row.ok();
    if (!has_row || !*has_row) break;
    const std::string text = ascii_text(statement->column(0).bytes);
    if (text == "ok") continue;
    is_sound = false;
    Finding found = finding;
    found.message += text;
    add(std::move(found));
  }
  connection.end_when(nullptr);
  if (!status) return status.error();
  return is_sound;
}

Status IntegrityCheck::check_schema() {
  std::set<std::string> known = {"chunks_by_place"};
  for (const auto& [table, begin] : kOwnTables) known.insert(table);
  for (const auto& [number, layout] : layouts_) known.insert(layout->table());
  auto rows = database_->connection().use("SELECT type, name FROM sqlite_schema WHERE name NOT LIKE 'sqlite_%'");
  if (!rows) return add({.message = kCatalogueFinding}, rows.error());
  while (true) {
    const auto has_row = rows->step();
    if (!has_row) return add({.message = kCatalogueFinding}, has_row.error());
    if (!*has_row) return {};
    const std::string name(rows->column(1).bytes);
    constexpr std::size_t kAfterPrefix = 4;
    const bool is_relation = name.starts_with("rel_") && rows->column(0).bytes == "table";
    const std::int64_t number = is_relation ? std::atoll(name.c_str() + kAfterPrefix) : 0;
    if (known.contains(name) || abandoned_.contains(number)) continue;
    // To SQLite a table has the same name in another case.
    const auto layout = layouts_.find(number);
    if (layout != layouts_.end() && sqlite3_stricmp(layout->second->table().c_str(), name.c_str()) == 0) continue;
    add({.message = fmt::format("the {} {} belongs to no object", rows->column(0).bytes, ascii_text(name))});
  }
}

// Compared with tables that are made now, as for a new database. Those of an older version are others.
Status IntegrityCheck::check_columns() {
  auto version = database_->connection().integer("PRAGMA user_version");
  if (!version || *version != kDatabaseVersion) return {};
  ASSIGN_OR_RETURN(const auto model, SqliteConnection::open_temporary());
  for (const char* sql : kCreateTables) RETURN_IF_ERROR(model->execute(sql));
  for (const auto& [number, layout] : layouts_) RETURN_IF_ERROR(model->execute(layout->create_sql()));
  for (const auto& [table, place] : tables()) {
    const bool is_new = place.object.empty() || std::ranges::any_of(layouts_, [&table = table](const auto& each) {
                          return each.second->table() == table;
                        });
    if (is_new) RETURN_IF_ERROR(check_columns_of(*model, table, place));
  }
  return check_meta();
}

// A table that is not there is told where it is read.
Status IntegrityCheck::check_columns_of(SqliteConnection& model, const std::string& table, const Finding& place) {
  ASSIGN_OR_RETURN(const std::vector<std::string> expected, column_names(model, table));
  const auto found = column_names(database_->connection(), table);
  if (!found) return add(place, found.error());
  if (found->empty()) return {};
  for (const std::string& name : *found) {
    if (std::ranges::find(expected, name) != expected.end()) continue;
    Finding added = place;
    added.message += fmt::format("the table {} has a column '{}' that does not belong there", table, ascii_text(name));
    add(std::move(added));
  }
  return {};
}

Status IntegrityCheck::check_meta() {
  const auto count = database_->connection().integer("SELECT count(*) FROM meta NOT INDEXED");
  const Finding place{.message = "the catalogue (table meta): "};
  if (!count) return add(place, count.error());
  if (*count != 1) add({.message = place.message + fmt::format("there are {} rows, 1 was written", *count)});
  return {};
}

}  // namespace queries
