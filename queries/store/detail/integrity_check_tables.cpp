// The part of the integrity check that looks at SQLite's pages, and at what tables and columns there are.
#include <algorithm>
#include <optional>

#include "base/propagate.h"
#include "queries/store/detail/integrity_check.h"
#include "queries/store/detail/pulled_tables.h"
#include "queries/store/detail/shape_levels.h"
#include "queries/store/detail/sqlite_error.h"
#include "queries/store/detail/tables.h"

namespace queries {
namespace {

/// The tables that are there once, and how findings about them begin.
constexpr std::pair<const char*, const char*> kOwnTables[] = {
    {"meta", "the catalogue (table meta): "},
    {"catalogue", "the catalogue (table catalogue): "},
    {"named_types", "the catalogue (table named_types): "},
    {"abandoned", "the catalogue (table abandoned): "},
    {"object_values", "the table object_values, which holds the values of objects that are not relations: "},
    {"chunks", "the table chunks, which holds long values: "},
    {"index_pages", "the table index_pages, which holds spatial indexes: "},
    {"row_groups", "the table row_groups, which holds tuples: "},
    {"column_chunks", "the table column_chunks, which holds tuples: "},
    {"shape_levels", "the table shape_levels, which holds levels of detail: "},
    {"imported_files", "the table imported_files, which says what was imported: "},
    {"pulled_tables", "the table pulled_tables, which says what was pulled from servers: "},
};

bool is_about_free_pages(std::string_view text) {
  const auto has = [text](std::string_view part) { return text.find(part) != std::string_view::npos; };
  return has("is never used") || has("reelist") || has("ist trunk") || has("reserved page") || has("ointer map");
}

/// The number behind `word` in a line of SQLite's check, and what follows.
struct Numbered {
  std::string number;
  std::string_view rest;
};

std::optional<Numbered> number_after(std::string_view line, std::string_view word) {
  const std::size_t at = line.find(word);
  if (at == std::string_view::npos) return std::nullopt;
  Numbered found;
  found.rest = line.substr(at + word.size());
  while (!found.rest.empty() && found.rest.front() >= '0' && found.rest.front() <= '9') {
    found.number += found.rest.front();
    found.rest.remove_prefix(1);
  }
  return found.number.empty() ? std::nullopt : std::optional(found);
}

/// A line of SQLite's check in plain words. Lines are `Page 12: btreeInitPage() returns error code 11`, `On tree page 4
/// cell 2: ...`, `Tree 4 page 4 cell 2: ...`, or sentences.
std::string plain_words(std::string_view line) {
  if (line == sqlite3_errstr(SQLITE_CORRUPT)) return "a page is damaged";
  if (const auto missing = number_after(line, "unable to get the page. error code="))
    if (const auto page = number_after(line, "age ")) return fmt::format("page {} is damaged or missing", page->number);
  if (const auto missing = number_after(line, "failed to get page "))
    return fmt::format("page {} is damaged or missing", missing->number);
  if (const auto missing = number_after(line, "invalid page number "))
    return fmt::format("page {} is missing", missing->number);
  for (const std::string_view word : {"Page ", "page "}) {
    const auto page = number_after(line, word);
    if (!page || page->rest.find(": ") == std::string_view::npos) continue;
    const std::string_view problem = page->rest.substr(page->rest.find(": ") + 2);
    if (problem.starts_with("btreeInitPage()")) return fmt::format("page {} is damaged", page->number);
    return fmt::format("page {} is damaged (SQLite: {})", page->number, ascii_text(problem));
  }
  if (const auto page = number_after(line, " on page "); page && page->rest.empty())
    return fmt::format("page {} is damaged (SQLite: {})", page->number, ascii_text(line));
  return "SQLite: " + ascii_text(line);
}

Result<std::vector<std::string>> column_names(SqliteConnection& connection, const std::string& table) {
  A3D_ASSIGN(SqliteStatement rows,
             connection.use(fmt::format("SELECT name FROM pragma_table_xinfo('{}') ORDER BY cid", table)));
  std::vector<std::string> names;
  while (true) {
    A3D_ASSIGN(const bool has_row, rows.step());
    if (!has_row) return names;
    names.emplace_back(rows.column(0).bytes);
  }
}

}  // namespace

/// All tables that belong here, each with the beginning of findings about it.
std::vector<std::pair<std::string, Finding>> IntegrityCheck::tables() {
  std::vector<std::pair<std::string, Finding>> result;
  // Some of them are in files that have something for them, or of this version.
  const auto has_levels = has_level_table(database_->connection());
  const auto has_pulled = has_pulled_tables(database_->connection());
  for (const auto& [table, begin] : kOwnTables) {
    const bool is_missing = (table == std::string_view("shape_levels") && has_levels && !*has_levels) ||
                            (table == std::string_view("pulled_tables") && has_pulled && !*has_pulled) ||
                            ((table == std::string_view("row_groups") || table == std::string_view("column_chunks")) &&
                             !database_->has_row_groups());
    if (!is_missing) result.emplace_back(table, Finding{.message = begin});
  }
  for (const auto& [name, entry] : database_->catalogue().entries()) {
    if (!entry.type.is_relation() || entry.table_number == 0) continue;
    const auto layout = database_->layout_of(entry);
    if (!layout) continue;
    result.emplace_back((*layout)->table(), Finding{.object = name});
    const auto keys = database_->key_attributes(**layout);
    for (const std::size_t attribute : keys ? **keys : std::vector<std::size_t>())
      result.emplace_back((*layout)->keys_table(attribute), Finding{.object = name});
  }
  return result;
}

// SQLite's check of the whole file ends at some kinds of damage, and says which tree is damaged and not whose it is. So
// if it finds anything, each table is checked alone.
Status IntegrityCheck::check_pages() {
  const std::size_t before = findings_.size();
  A3D_ASSIGN(const bool is_sound, check_pages_of("PRAGMA integrity_check", {}));
  if (is_sound) return {};
  std::vector<Finding> general(findings_.begin() + static_cast<std::ptrdiff_t>(before), findings_.end());
  findings_.resize(before);
  finding_counts_.erase("");
  for (const Finding& each : findings_) finding_counts_[each.object] += each.object.empty() ? 1 : 0;
  bool is_explained = !findings_.empty();
  for (const auto& [table, place] : tables()) {
    A3D_TRY(context_.check_cancelled());
    A3D_ASSIGN(const bool is_whole, check_pages_of(fmt::format("PRAGMA integrity_check('{}')", table), place));
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
  auto statement = connection.use(sql);
  if (!statement) {
    A3D_TRY(add(place, statement.error()));
    return false;
  }
  connection.end_when(context_.cancel);
  bool is_sound = true;
  Status status;
  while (true) {
    const auto has_row = statement->step();
    // An error after lines about damaged pages says nothing more.
    if (!has_row && (is_sound || has_row.error().code != ErrorCode::database_corrupt))
      status = add(place, has_row.error());
    is_sound = is_sound && has_row.ok();
    if (!has_row || !*has_row) break;
    std::string_view text = statement->column(0).bytes;
    if (text == "ok") continue;
    is_sound = false;
    while (!text.empty()) {
      const std::string_view line = text.substr(0, text.find('\n'));
      add_page_finding(place, line);
      text.remove_prefix(std::min(text.size(), line.size() + 1));
    }
  }
  connection.end_when(nullptr);
  if (!status) return status.error();
  return is_sound;
}

void IntegrityCheck::add_page_finding(const Finding& place, std::string_view line) {
  if (line.empty() || line.starts_with("*** in database")) return;
  Finding found = place;
  std::string words = plain_words(line);
  for (const PageFault& fault : database_->connection().page_faults())
    if (words.starts_with(fmt::format("page {} is damaged", fault.page))) words = page_fault_text(fault);
  found.message += words;
  const bool is_told =
      !findings_.empty() && findings_.back().object == found.object && findings_.back().message == found.message;
  if (is_told) return;
  add(std::move(found));
}

/// Whether an index of SQLite, or a key table, is that of an ordered index on a relation that is there or was
/// abandoned.
bool IntegrityCheck::is_stored_order(const std::string& name) const {
  const bool is_key_table = name.starts_with("keys_");
  const auto number = number_after(name, is_key_table ? "keys_" : "order_");
  if ((!is_key_table && !name.starts_with("order_")) || !number) return false;
  const std::int64_t table = std::atoll(number->number.c_str());
  if (abandoned_.contains(table)) return true;
  const auto layout = layouts_.find(table);
  if (layout == layouts_.end()) return false;
  return std::ranges::any_of(database_->catalogue().entries(), [&](const auto& each) {
    const CatalogueEntry& entry = each.second;
    if (!entry.type.is("btree") || entry.index_relation != layout->second->relation()) return false;
    const std::size_t attribute = layout->second->find(entry.index_attribute);
    if (attribute == layout->second->attributes().size()) return false;
    return (is_key_table ? layout->second->keys_table(attribute) : layout->second->order_name(attribute)) == name;
  });
}

Status IntegrityCheck::check_schema() {
  std::set<std::string> known = {"chunks_by_place"};
  for (const auto& [table, begin] : kOwnTables) known.insert(table);
  for (const auto& [number, layout] : layouts_) known.insert(layout->table());
  auto rows =
      database_->connection().use("SELECT type, name, tbl_name FROM sqlite_schema WHERE name NOT LIKE 'sqlite_%'");
  if (!rows) return add({.message = kCatalogueFinding}, rows.error());
  while (true) {
    const auto has_row = rows->step();
    if (!has_row) return add({.message = kCatalogueFinding}, has_row.error());
    if (!*has_row) return {};
    const std::string name(rows->column(1).bytes);
    constexpr std::size_t kAfterPrefix = 4;
    const bool is_relation = name.starts_with("rel_") && rows->column(0).bytes == "table";
    const std::int64_t number = is_relation ? std::atoll(name.c_str() + kAfterPrefix) : 0;
    if (known.contains(name) || abandoned_.contains(number) || is_stored_order(name)) continue;
    // To SQLite a table has the same name in another case.
    const auto layout = layouts_.find(number);
    if (layout != layouts_.end() && sqlite3_stricmp(layout->second->table().c_str(), name.c_str()) == 0) continue;
    if (rows->column(0).bytes == "index")
      add({.message = fmt::format("the table {} has an index {} that belongs to no object",
                                  ascii_text(rows->column(2).bytes), ascii_text(name))});
    else
      add({.message = fmt::format("the {} {} belongs to no object", rows->column(0).bytes, ascii_text(name))});
  }
}

// Compared with tables that are made now, as for a new database. Those of an older version are others.
Status IntegrityCheck::check_columns() {
  auto version = database_->connection().integer("PRAGMA user_version");
  if (!version || *version < kLastVersionWithoutPageSums) return {};
  A3D_ASSIGN(const auto model, SqliteConnection::open_temporary());
  for (const char* sql : kCreateTables)
    if (database_->has_row_groups() || (sql != kCreateRowGroups && sql != kCreateColumnChunks))
      A3D_TRY(model->execute(sql));
  A3D_TRY(model->execute(kCreateShapeLevels));
  A3D_TRY(model->execute(kCreatePulledTables));
  for (const auto& [number, layout] : layouts_) A3D_TRY(model->execute(layout->create_sql()));
  for (const auto& [table, place] : tables()) {
    const bool is_new = place.object.empty() || std::ranges::any_of(layouts_, [&table = table](const auto& each) {
                          return each.second->table() == table;
                        });
    if (is_new) A3D_TRY(check_columns_of(*model, table, place));
  }
  A3D_TRY(check_indexes(*model));
  A3D_TRY(check_stored_orders());
  return check_meta();
}

// SQLite does not miss an index that is not part of its table, only the time that it saves and the proof of uniqueness.
Status IntegrityCheck::check_indexes(SqliteConnection& model) {
  A3D_ASSIGN(SqliteStatement expected,
             model.use("SELECT name, tbl_name, sql FROM sqlite_schema WHERE type = 'index' AND sql IS NOT NULL"));
  while (true) {
    A3D_ASSIGN(const bool has_row, expected.step());
    if (!has_row) return {};
    const std::string name(expected.column(0).bytes);
    const std::string table(expected.column(1).bytes);
    auto found = database_->connection().use("SELECT sql FROM sqlite_schema WHERE type = 'index' AND name = ?");
    if (!found) return add({.message = kCatalogueFinding}, found.error());
    const auto is_there = found->bind(1, std::string_view(name)).step();
    if (!is_there) return add({.message = kCatalogueFinding}, is_there.error());
    const bool is_same = *is_there && found->column(0).bytes == expected.column(2).bytes;
    if (!is_same)
      add({.message = fmt::format("the table {}: its index {} is {}", table, name,
                                  *is_there ? "not as it was made" : "not there")});
  }
}

// SQLite's own check has reported whether it has the values of the rows.
Status IntegrityCheck::check_stored_orders() {
  for (const auto& [number, layout] : layouts_)
    for (std::size_t attribute = 0; attribute < layout->attributes().size(); ++attribute)
      A3D_TRY(check_stored_order(*layout, attribute));
  return {};
}

/// An object that is an ordered index on an attribute; null if there is none.
const CatalogueEntry* IntegrityCheck::order_definition(const RelationLayout& layout, std::size_t attribute) const {
  for (const auto& [name, entry] : database_->catalogue().entries())
    if (entry.type.is("btree") && entry.has_value && entry.index_relation == layout.relation() &&
        entry.index_attribute == layout.attributes()[attribute].name)
      return &entry;
  return nullptr;
}

// Files of older versions get their indexes when these are first asked. One that was partial, or in another order,
// would be passed over by our questions.
Status IntegrityCheck::check_stored_order(const RelationLayout& layout, std::size_t attribute) {
  const AttributeColumns& columns = layout.attributes()[attribute];
  if (!columns.has_native_order()) return {};
  const std::string name = layout.order_name(attribute);
  const Finding place{.object = layout.relation(), .attribute = columns.name};
  auto found = database_->connection().use(
      "SELECT i.tbl_name, c.name, c.\"desc\", c.coll, l.\"unique\", l.partial, "
      "(SELECT count(*) FROM pragma_index_info(i.name)) FROM sqlite_schema AS i, pragma_index_xinfo(i.name) AS c, "
      "pragma_index_list(i.tbl_name) AS l WHERE i.type = 'index' AND i.name = ? AND l.name = i.name AND c.seqno = 0");
  if (!found) return add(place, found.error());
  const auto has_row = found->bind(1, std::string_view(name)).step();
  if (!has_row) return add(place, has_row.error());
  A3D_ASSIGN(const std::vector<std::size_t>* keys, database_->key_attributes(layout));
  const bool has_keys = std::ranges::find(*keys, attribute) != keys->end();
  const auto on = has_keys ? RelationLayout::OrderOn::keys : RelationLayout::OrderOn::table;
  if (!*has_row) {
    const CatalogueEntry* const index = order_definition(layout, attribute);
    const bool is_made_later = database_->catalogue().version() <= kLastVersionWithoutPageSums;
    if (index != nullptr && !is_made_later)
      add({.object = index->name,
           .message = fmt::format("the stored index {} is not there: another program has dropped it; it is made anew "
                                  "when it is next used",
                                  name)});
    return {};
  }
  const bool is_right =
      sqlite3_stricmp(std::string(found->column(0).bytes).c_str(), layout.order_table(attribute, on).c_str()) == 0 &&
      found->column(1).bytes == layout.order_column(attribute, on) && found->column(2).integer == 0 &&
      found->column(3).bytes == "BINARY" && found->column(4).integer == 0 && found->column(5).integer == 0 &&
      found->column(6).integer == 1;
  Finding wrong = place;
  wrong.message = fmt::format("the index {} is not as it was made", name);
  if (!is_right) add(std::move(wrong));
  return {};
}

// A missing table is reported where it is read.
Status IntegrityCheck::check_columns_of(SqliteConnection& model, const std::string& table, const Finding& place) {
  A3D_ASSIGN(const std::vector<std::string> expected, column_names(model, table));
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

// What `kill` left: numbers that were given, of no object that is there, whose rows are there.
Status IntegrityCheck::check_abandoned() {
  std::set<std::int64_t> in_use;
  for (const auto& [name, entry] : database_->catalogue().entries())
    in_use.insert(entry.type.is_relation() ? entry.table_number : entry.id);
  const bool knows_next = database_->catalogue().damage().empty();
  for (const std::int64_t number : abandoned_) {
    std::string_view wrong;
    if (in_use.contains(number)) {
      wrong = "which belongs to an object that is there";
    } else if (number < 1 || (knows_next && number >= database_->catalogue().next_number())) {
      wrong = "which was never given";
    } else {
      const auto found = has_rows(number);
      if (!found) A3D_TRY(add({.message = "the catalogue (table abandoned): "}, found.error()));
      if (found && !*found) wrong = "of which nothing is there";
    }
    if (!wrong.empty())
      add({.message =
               fmt::format("the catalogue (table abandoned): there is a row of the number {}, {}", number, wrong)});
  }
  return {};
}

/// Whether there is a table of this number, or a value of an object of this number.
Result<bool> IntegrityCheck::has_rows(std::int64_t number) {
  A3D_ASSIGN(const std::int64_t tables,
             database_->connection().integer(fmt::format(
                 "SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name GLOB 'rel_{}_*'", number)));
  if (tables > 0) return true;
  A3D_ASSIGN(const std::int64_t values,
             database_->connection().integer(fmt::format("SELECT count(*) FROM object_values WHERE id = {}", number)));
  return values > 0;
}

Status IntegrityCheck::check_meta() {
  const auto count = database_->connection().integer("SELECT count(*) FROM meta NOT INDEXED");
  const Finding place{.message = "the catalogue (table meta): "};
  if (!count) return add(place, count.error());
  if (*count != 1) add({.message = place.message + fmt::format("there are {} rows, 1 was written", *count)});
  return {};
}

}  // namespace queries
