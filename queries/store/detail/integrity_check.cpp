#include "queries/store/detail/integrity_check.h"

#include <algorithm>
#include <array>

#include "algebra3d/values/types/codec.h"
#include "base/error_subject.h"
#include "base/propagate.h"
#include "queries/store/detail/frozen_index.h"
#include "queries/store/detail/frozen_order.h"
#include "queries/store/detail/index_pages.h"
#include "queries/store/detail/pulled_tables.h"
#include "queries/store/detail/sqlite_error.h"
#include "queries/store/detail/stored_object.h"
#include "queries/store/detail/tables.h"

namespace queries {
namespace {

/// The findings listed for one object; further ones are counted.
constexpr std::size_t kFindingsPerObject = 100;
constexpr std::uint64_t kStepsPerReport = 64;

bool is_damage(ErrorCode code) {
  return code == ErrorCode::database_corrupt || code == ErrorCode::database_version ||
         code == ErrorCode::invalid_value || code == ErrorCode::type_error;
}

}  // namespace

std::string Finding::text() const {
  std::string result;
  if (!object.empty()) result += object + ": ";
  if (tuple != 0) result += fmt::format("tuple {}: ", tuple);
  if (!attribute.empty()) result += fmt::format("'{}': ", attribute);
  return result + message;
}

Result<std::vector<Finding>> IntegrityCheck::run() {
  A3D_TRY(database_->check_reading());
  const auto& entries = database_->catalogue().entries();
  for (const auto& [name, entry] : entries)
    done_.total += 1 + (entry.type.is_relation() ? static_cast<std::uint64_t>(entry.tuple_count) : 0);
  database_->connection().forget_pages();
  A3D_TRY(check_catalogue());
  A3D_TRY(check_pages());
  for (const auto& [name, entry] : entries) A3D_TRY(check_object(entry));
  A3D_TRY(check_schema());
  A3D_TRY(check_columns());
  A3D_TRY(check_numbers("object_values", "id"));
  A3D_TRY(check_numbers("imported_files", "relation"));
  const auto has_pulled = has_pulled_tables(database_->connection());
  if (!has_pulled || *has_pulled) A3D_TRY(check_numbers("pulled_tables", "relation"));
  A3D_TRY(check_chunks());
  A3D_TRY(check_group_tables());
  A3D_TRY(check_index_pages());
  A3D_TRY(check_levels());
  A3D_TRY(check_abandoned());
  add_page_faults();
  add_readable_objects();
  for (const auto& [name, count] : finding_counts_)
    if (count > kFindingsPerObject)
      findings_.push_back({name, 0, "", fmt::format("{} more findings", count - kFindingsPerObject)});
  return std::move(findings_);
}

void IntegrityCheck::add(Finding finding) {
  if (++finding_counts_[finding.object] <= kFindingsPerObject) findings_.push_back(std::move(finding));
}

// A finding says itself what it is about, and advises nothing.
Status IntegrityCheck::add(Finding finding, const Error& error) {
  if (!is_damage(error.code)) return error;
  Error told = error;
  for (const std::string& what : {database_->file().string(), finding.object, fmt::format("tuple {}", finding.tuple)})
    told = algebra3d::without_subject(std::move(told), what);
  std::string text = told.text();
  if (text.ends_with(kPageFaultRemedy)) text.resize(text.size() - kPageFaultRemedy.size());
  finding.message += text;
  add(std::move(finding));
  return {};
}

Status IntegrityCheck::advance(const std::string& object) {
  A3D_TRY(context_.check_cancelled());
  const bool is_new = object != done_.object;
  done_.object = object;
  ++done_.done;
  if (progress_ && (is_new || done_.done % kStepsPerReport == 0)) progress_(done_);
  return {};
}

// The catalogue in memory was proved when it was read, which may be long ago.
Status IntegrityCheck::check_catalogue() {
  for (const std::string& damage : database_->catalogue().damage())
    add({.message = std::string(kCatalogueFinding) + damage});
  Catalogue fresh(database_->connection());
  const Status status = database_->catalogue().damage().empty() ? fresh.load() : Status();
  if (!status) A3D_TRY(add({.message = kCatalogueFinding}, status.error()));
  auto statement = database_->connection().use("SELECT number FROM abandoned");
  if (!statement) return {};  // version 1
  while (true) {
    const auto has_row = statement->step();
    if (!has_row) return add({.message = kCatalogueFinding}, has_row.error());
    if (!*has_row) return {};
    abandoned_.insert(statement->column(0).integer);
  }
}

// Those that no finding has named: in a database that does not open, they are read as they are.
void IntegrityCheck::add_page_faults() {
  for (const PageFault& fault : database_->connection().page_faults()) {
    const std::string text = page_fault_text(fault);
    const bool is_told = std::ranges::any_of(
        findings_, [&](const Finding& each) { return each.message.find(text) != std::string::npos; });
    if (!is_told) add({.message = "the file: " + text});
  }
}

// For a database that does not open: the objects that are not reported as damaged can be saved.
void IntegrityCheck::add_readable_objects() {
  if (!database_->catalogue().is_tolerant() || findings_.empty()) return;
  const auto is_damaged = [&](const std::string& name) { return !name.empty() && finding_counts_.contains(name); };
  std::string readable;
  for (const auto& [name, entry] : database_->catalogue().entries()) {
    if (is_damaged(name) || is_damaged(entry.index_relation)) continue;
    readable += (readable.empty() ? "" : ", ") + name;
    if (entry.type.is_relation()) readable += fmt::format(" ({} tuples)", entry.tuple_count);
  }
  add({.message = kCatalogueFinding + (readable.empty() ? "no object can be read completely"
                                                        : "these objects can still be read completely: " + readable)});
}

Status IntegrityCheck::check_object(const CatalogueEntry& entry) {
  A3D_TRY(advance(entry.name));
  if (!entry.has_value || entry.type.is_function()) return {};
  if (entry.type.is_relation()) return check_relation(entry);
  return entry.index_relation.empty() ? check_value(entry) : check_definition(entry);
}

Status IntegrityCheck::check_value(const CatalogueEntry& entry) {
  const auto bytes = read_object_bytes(*database_, entry);
  if (!bytes) return add({.object = entry.name}, bytes.error());
  if (entry.type.is("rtree3")) {
    const auto tree = decode_tree(*bytes);
    return tree ? Status() : add({.object = entry.name}, tree.error());
  }
  const bool is_ordered = entry.type.is("btree");
  const algebra3d::Type* const type =
      is_ordered ? ordered_key_type(database_->registry(), entry.type) : database_->registry().value_type(entry.type);
  if (type == nullptr) {
    add({.object = entry.name, .message = fmt::format("the type {} is not known", entry.type.text())});
    return {};
  }
  if (is_ordered) {
    const auto tree = decode_order(*type, *bytes);
    return tree ? Status() : add({.object = entry.name}, tree.error());
  }
  const auto value = algebra3d::decode(*type, *bytes, algebra3d::Origin::elsewhere);
  return value ? Status() : add({.object = entry.name}, value.error());
}

// The tree itself is compared when its relation is read.
Status IntegrityCheck::check_definition(const CatalogueEntry& entry) {
  const CatalogueEntry* const relation = database_->catalogue().find(entry.index_relation);
  if (relation == nullptr || !relation->type.is_relation()) {
    add({.object = entry.name,
         .message = fmt::format("the index is on the relation '{}', which is not there", entry.index_relation)});
    return {};
  }
  const auto layout = database_->layout_of(*relation);
  if (!layout) return add({.object = entry.name}, layout.error());
  const std::size_t position = (*layout)->find(entry.index_attribute);
  const bool is_there = position < (*layout)->attributes().size();
  if (!is_there || (entry.type.is("rtree3") && !(*layout)->attributes()[position].has_box()))
    add({.object = entry.name,
         .message = fmt::format("the relation '{}' has no attribute '{}' for the index", entry.index_relation,
                                entry.index_attribute)});
  return {};
}

// Index pages that belong to no index: their object is of another type, or gone.
Status IntegrityCheck::check_index_pages() {
  if (database_->catalogue().version() < kFirstVersionWithIndexPages) return {};
  std::set<std::int64_t> known = abandoned_;
  for (const auto& [name, entry] : database_->catalogue().entries())
    if (entry.type.is("rtree3")) known.insert(entry.id);
  const Finding where{.message = "the table index_pages, which holds spatial indexes: "};
  std::int64_t from = INT64_MIN;
  while (true) {
    auto next =
        database_->connection().use("SELECT place >> 32 FROM index_pages WHERE place >= ? ORDER BY place LIMIT 1");
    if (!next) return add(where, next.error());
    const auto has_row = next->bind(1, from).step();
    if (!has_row) return add(where, has_row.error());
    if (!*has_row) return {};
    const std::int64_t owner = next->column(0).integer;
    if (!known.contains(owner))
      add({.message =
               fmt::format("the table index_pages has rows of the object number {}, which is not there", owner)});
    if (owner >= INT32_MAX) return {};
    from = IndexPage{owner + 1, 0}.place();
  }
}

Status IntegrityCheck::check_numbers(std::string_view table, std::string_view column) {
  std::set<std::int64_t> known = abandoned_;
  for (const auto& [name, entry] : database_->catalogue().entries()) known.insert(entry.id);
  auto rows = database_->connection().use(fmt::format("SELECT DISTINCT {} FROM {} NOT INDEXED", column, table));
  const Finding place{.message = fmt::format("the table {}: ", table)};
  if (!rows) return add(place, rows.error());
  while (true) {
    A3D_TRY(context_.check_cancelled());
    const auto has_row = rows->step();
    if (!has_row) return add(place, has_row.error());
    if (!*has_row) return {};
    const std::int64_t number = rows->column(0).integer;
    if (!known.contains(number))
      add({.message = fmt::format("the table {} has rows of the object number {}, which is not there", table, number)});
  }
}

Status IntegrityCheck::check_chunks() {
  auto rows = database_->connection().use("SELECT DISTINCT owner, tuple, attribute FROM chunks");
  const Finding where{.message = "the table chunks, which holds long values: "};
  if (!rows) return add(where, rows.error());
  while (true) {
    A3D_TRY(context_.check_cancelled());
    const auto has_row = rows->step();
    if (!has_row) return add(where, has_row.error());
    if (!*has_row) return {};
    const std::array place = {rows->column(0).integer, rows->column(1).integer, rows->column(2).integer};
    if (abandoned_.contains(place[0] != 0 ? place[0] : place[1])) continue;
    const auto wanted = has_chunks(place[0], place[1], place[2]);
    if (!wanted) A3D_TRY(add(where, wanted.error()));
    if (wanted && !*wanted)
      add({.message = fmt::format("there are chunks of a value that is not there: owner {}, tuple {}, attribute {}",
                                  place[0], place[1], place[2])});
  }
}

// The place of a value that lies in chunks holds its length.
Result<bool> IntegrityCheck::has_chunks(std::int64_t owner, std::int64_t tuple, std::int64_t attribute) {
  std::string sql = "SELECT value FROM object_values WHERE id = ?";
  if (owner != 0) {
    const auto layout = layouts_.find(owner);
    if (layout == layouts_.end() || attribute < 0) return false;
    const auto position = static_cast<std::size_t>(attribute);
    const auto& attributes = layout->second->attributes();
    if (position >= attributes.size() || attributes[position].form != AttributeForm::large) return false;
    sql = layout->second->bytes_sql(position);
  }
  A3D_ASSIGN(SqliteStatement statement, database_->connection().use(sql));
  statement.bind(1, tuple);
  A3D_ASSIGN(const bool has_row, statement.step());
  return has_row && statement.column(0).is(Cell::Kind::integer);
}

}  // namespace queries
