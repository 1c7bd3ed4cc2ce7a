#include "queries/store/detail/relation_layout.h"

#include <algorithm>

#include <fmt/format.h>
#include <sqlite3.h>

#include "algebra3d/values/types/scalars.h"
#include "queries/store/detail/row_sink.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Registry;
using algebra3d::Result;
using algebra3d::Type;
using algebra3d::TypeExpr;
using algebra3d::TypeOf;

/// SQLite's own limit is 2000 columns.
constexpr std::size_t kMaxColumns = 1900;
constexpr std::size_t kNameKept = 40;

/// The characters of a name that may stand in SQL as they are: names of ours are letters, digits and `_`, but a file
/// may hold any.
std::string plain(const std::string& name) {
  std::string result;
  for (const char c : name.substr(0, kNameKept)) {
    const bool is_plain = ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9');
    result += is_plain ? c : '_';
  }
  return result;
}

AttributeForm form_of(const Type& type) {
  switch (type.storage()) {
    case Type::Storage::integer:
      return &type == &TypeOf<bool>::type() ? AttributeForm::boolean : AttributeForm::integer;
    case Type::Storage::real:
      return AttributeForm::real;
    case Type::Storage::text:
      return &type == &TypeOf<algebra3d::Text>::type() ? AttributeForm::text : AttributeForm::string;
    case Type::Storage::bytes:
      break;
  }
  if (type.is_large()) return AttributeForm::large;
  return type.is_spatial() ? AttributeForm::spatial : AttributeForm::bytes;
}

bool is_number(AttributeForm form) {
  return form == AttributeForm::real || form == AttributeForm::integer || form == AttributeForm::boolean;
}

/// Doubles stand in columns without a type: one of type REAL turns -0.0 into 0.0.
constexpr std::string_view kAsBound;

}  // namespace

Result<std::shared_ptr<const RelationLayout>> RelationLayout::make(const Registry& registry, const TypeExpr& tuple,
                                                                   const std::string& relation,
                                                                   std::int64_t table_number) {
  std::shared_ptr<RelationLayout> layout(new RelationLayout());
  layout->relation_ = relation;
  layout->table_number_ = table_number;
  layout->tuple_ = tuple;
  layout->table_ = fmt::format("rel_{}_{}", table_number, plain(relation));
  for (const auto& [name, type_expr] : tuple.attributes()) {
    const Type* type = registry.value_type(type_expr);
    if (type == nullptr)
      return Error{ErrorCode::type_error, "an attribute of type {} cannot be stored", type_expr.text()}.about(name);
    layout->attributes_.push_back({name, type, form_of(*type)});
  }
  for (std::size_t i = 0; i < layout->attributes_.size(); ++i)
    layout->attributes_[i].keys_table = fmt::format("keys_{}_{}", table_number, i + 1);
  layout->add_columns();
  if (layout->columns_.size() > kMaxColumns)
    return Error{ErrorCode::limit_exceeded, "the {} attributes need {} columns, a table has at most {}",
                 tuple.attributes().size(), layout->columns_.size(), kMaxColumns}
        .about(relation);
  layout->add_statements();
  return std::shared_ptr<const RelationLayout>(std::move(layout));
}

std::size_t RelationLayout::add_column(std::string name, std::string_view sql_type) {
  columns_.push_back(std::move(name));
  column_types_.emplace_back(sql_type);
  return columns_.size() - 1;
}

// The number before the name keeps `Name` and `name` apart, which are the same to SQLite.
void RelationLayout::add_columns() {
  const auto name_of = [&](const AttributeColumns& attribute) {
    return fmt::format("a{}_{}", &attribute - attributes_.data() + 1, plain(attribute.name));
  };
  add_column("id", "INTEGER PRIMARY KEY");
  add_column("checksum", "INTEGER");
  for (auto& attribute : attributes_)
    if (is_number(attribute.form))
      attribute.value = add_column(name_of(attribute),
                                   attribute.form == AttributeForm::real ? kAsBound : std::string_view("INTEGER"));
  for (auto& attribute : attributes_) {
    if (!attribute.has_box()) continue;
    attribute.box = columns_.size();
    for (const char* part : {"minx", "miny", "minz", "maxx", "maxy", "maxz"})
      add_column(name_of(attribute) + "_" + part, kAsBound);
    add_column(name_of(attribute) + "_size", "INTEGER");
    if (attribute.form == AttributeForm::large) add_column(name_of(attribute) + "_checksum", "INTEGER");
  }
  for (auto& attribute : attributes_)
    if (attribute.form == AttributeForm::string || attribute.form == AttributeForm::text)
      attribute.value = add_column(name_of(attribute), "TEXT");
  for (auto& attribute : attributes_)
    if (attribute.form == AttributeForm::bytes || attribute.form == AttributeForm::spatial)
      attribute.value = add_column(name_of(attribute), "BLOB");
  small_count_ = columns_.size();
  for (auto& attribute : attributes_)
    if (attribute.form == AttributeForm::large) attribute.value = add_column(name_of(attribute), "BLOB");
}

void RelationLayout::add_statements() {
  std::string parameters = "?";
  for (std::size_t i = 1; i < columns_.size(); ++i) parameters += ", ?";
  insert_sql_ = fmt::format("INSERT INTO {} VALUES({})", table_, parameters);
  erase_sql_ = fmt::format("DELETE FROM {} WHERE id = ?", table_);
  std::string small = columns_[0];
  for (std::size_t i = 1; i < small_count_; ++i) small += ", " + columns_[i];
  tail_sql_ = fmt::format("SELECT {} FROM {} WHERE id >= ? ORDER BY id LIMIT ?", small, table_);
  range_sql_ = fmt::format("SELECT {} FROM {} WHERE id >= ? AND id <= ? ORDER BY id", small, table_);
  fetch_sql_ = fmt::format("SELECT {} FROM {} WHERE id = ?", small, table_);
}

std::string RelationLayout::page_sql(std::span<const std::size_t> columns) const {
  std::string list;
  for (const std::size_t column : columns) list += (list.empty() ? "" : ", ") + columns_[column];
  const char* const text = columns.size() <= RowSink::kMaxColumns
                               ? "SELECT 1 FROM {1} WHERE id > ? AND id <= ? AND take_row(?, {0}) ORDER BY id"
                               : "SELECT {0} FROM {1} WHERE id > ? AND id <= ? ORDER BY id LIMIT ?";
  return fmt::format(fmt::runtime(text), list, table_);
}

std::string RelationLayout::ids_sql() const {
  return fmt::format("SELECT id FROM {} WHERE id >= ? AND id <= ? ORDER BY id", table_);
}

std::string RelationLayout::erase_range_sql() const {
  return fmt::format("DELETE FROM {} WHERE id >= ? AND id <= ?", table_);
}

std::string RelationLayout::create_sql() const {
  std::string sql = fmt::format("CREATE TABLE {}(", table_);
  for (std::size_t i = 0; i < columns_.size(); ++i)
    sql +=
        fmt::format("{}{}{}{}", i == 0 ? "" : ", ", columns_[i], column_types_[i].empty() ? "" : " ", column_types_[i]);
  return sql + ")";
}

// SQLite's names know no case.
std::string RelationLayout::rename_sql(const RelationLayout& renamed) const {
  if (sqlite3_stricmp(table_.c_str(), renamed.table_.c_str()) == 0) return {};
  return fmt::format("ALTER TABLE {} RENAME TO {}", table_, renamed.table_);
}

std::string RelationLayout::bytes_sql(std::size_t attribute) const {
  return fmt::format("SELECT {} FROM {} WHERE id = ?", columns_[attributes_[attribute].value], table_);
}

std::string RelationLayout::update_sql(std::span<const std::size_t> columns) const {
  std::string sql = "UPDATE " + table_ + " SET ";
  for (const std::size_t column : columns) sql += columns_[column] + " = ?, ";
  sql.resize(sql.size() - 2);
  return sql + " WHERE id = ?";
}

// Without the name of the relation: SQLite cannot rename an index.
std::string RelationLayout::order_name(std::size_t attribute) const {
  return fmt::format("order_{}_{}", table_number_, attribute + 1);
}

const std::string& RelationLayout::order_table(std::size_t attribute, OrderOn on) const {
  return on == OrderOn::keys ? keys_table(attribute) : table_;
}

const std::string& RelationLayout::order_column(std::size_t attribute, OrderOn on) const {
  static const std::string kKey = "key";
  return on == OrderOn::keys ? kKey : columns_[attributes_[attribute].value];
}

std::string RelationLayout::create_order_sql(std::size_t attribute, OrderOn on) const {
  return fmt::format("CREATE INDEX {} ON {}({})", order_name(attribute), order_table(attribute, on),
                     order_column(attribute, on));
}

// The key has no type, as the column of a real has none.
std::string RelationLayout::create_keys_sql(std::size_t attribute) const {
  return fmt::format("CREATE TABLE {}(id INTEGER PRIMARY KEY, key)", keys_table(attribute));
}

std::string RelationLayout::fill_keys_sql(std::size_t attribute) const {
  return fmt::format("INSERT INTO {} SELECT id, {} FROM {} ORDER BY id", keys_table(attribute),
                     columns_[attributes_[attribute].value], table_);
}

std::string RelationLayout::drop_keys_sql(std::size_t attribute) const {
  return "DROP TABLE IF EXISTS " + keys_table(attribute);
}

std::string RelationLayout::insert_key_sql(std::size_t attribute) const {
  return fmt::format("INSERT INTO {} VALUES(?, ?)", keys_table(attribute));
}

std::string RelationLayout::update_key_sql(std::size_t attribute) const {
  return fmt::format("UPDATE {} SET key = ? WHERE id = ?", keys_table(attribute));
}

std::string RelationLayout::erase_key_sql(std::size_t attribute) const {
  return fmt::format("DELETE FROM {} WHERE id = ?", keys_table(attribute));
}

std::string RelationLayout::drop_order_sql(std::size_t attribute) const {
  return "DROP INDEX IF EXISTS " + order_name(attribute);
}

bool RelationLayout::has_columns() const {
  return !attributes_.empty() && std::ranges::none_of(attributes_, [](const AttributeColumns& attribute) {
    return attribute.form == AttributeForm::large;
  });
}

std::size_t RelationLayout::find(const std::string& attribute) const {
  const auto found = std::ranges::find(attributes_, attribute, &AttributeColumns::name);
  return static_cast<std::size_t>(found - attributes_.begin());
}

}  // namespace queries
