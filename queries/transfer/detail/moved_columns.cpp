#include "queries/transfer/detail/moved_columns.h"

#include <algorithm>
#include <cctype>
#include <set>

#include <fmt/format.h>

#include "algebra3d/base/monitor.h"
#include "algebra3d/values/types/utf8.h"
#include "base/propagate.h"
#include "queries/language/parser.h"

namespace queries {
namespace {

/// Columns that do not fit, for one message.
class Differences {
 public:
  template <typename... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    text_ += (text_.empty() ? "" : "; ") + fmt::format(format, std::forward<Args>(args)...);
  }
  /// `subject`: "the table T and the relation R do not fit".
  Status status(std::string_view subject) const {
    if (text_.empty()) return {};
    return Error{ErrorCode::type_error, "{}: {}", subject, text_};
  }

 private:
  std::string text_;
};

const ServerColumn* column_named(const ServerTable& table, std::string_view name) {
  const auto found = std::ranges::find(table.columns, name, &ServerColumn::name);
  return found != table.columns.end() ? &*found : nullptr;
}

const ServerColumn* column_of(const ServerTable& table, const std::string& attribute) {
  const ServerColumn* const exact = column_named(table, attribute);
  return exact != nullptr ? exact : column_named(table, column_name(attribute));
}

/// Whether values can be sent to a column as they are.
bool takes(const ServerColumn& column, const ColumnType& type) {
  const bool is_extended = type.form == ColumnType::Form::set || type.form == ColumnType::Form::small_set;
  return is_extended ? column.extension_type == type.type->name() : column.type == type.sql_name;
}

std::string fit_subject(const ServerTable& table, std::string_view relation) {
  return fmt::format("the table {} does not fit {}", table.text(),
                     relation.empty() ? "the relation" : fmt::format("the relation '{}'", relation));
}

}  // namespace

std::string column_name(std::string_view attribute) {
  std::string name(attribute);
  for (char& letter : name) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return name;
}

std::string attribute_name(std::string_view column) {
  std::string name;
  for (const char letter : column) {
    if (algebra3d::is_utf8_continuation(letter)) continue;
    const bool fits = std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
    name += fits ? letter : '_';
  }
  if (!name.empty()) name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
  return name;
}

std::string MovedColumns::names_sql() const {
  std::string sql;
  for (const MovedColumn& each : columns_) sql += (sql.empty() ? "" : ", ") + quoted_identifier(each.column);
  return sql;
}

std::string MovedColumns::definitions_sql() const {
  std::string sql;
  for (const MovedColumn& each : columns_)
    sql += fmt::format("{}{} {}", sql.empty() ? "" : ", ", quoted_identifier(each.column), each.type.sql_name);
  return sql;
}

std::string MovedColumns::sent_sql() const {
  std::string sql;
  for (const MovedColumn& each : columns_)
    sql += (sql.empty() ? "" : ", ") + each.type.sent_sql(quoted_identifier(each.column));
  return sql;
}

Result<RowDigest> MovedColumns::digest_of(ServerConnection& connection, const ServerTable& table,
                                          const std::string& condition) const {
  std::vector<std::string> hashed;
  hashed.reserve(columns_.size());
  for (const MovedColumn& each : columns_) hashed.push_back(each.type.hashed_sql(quoted_identifier(each.column)));
  A3D_ASSIGN(const ServerAnswer answer,
             connection.query(fmt::format("SELECT {} FROM ONLY {}{}", row_digest_sql(hashed), table.sql(),
                                          condition.empty() ? "" : " WHERE " + condition)));
  return row_digest_of_texts(answer.text(0, 0), answer.text(0, 1));
}

Result<MovedColumns::Row> MovedColumns::row_of(const Tuple& tuple) const {
  Row row;
  row.fields.resize(columns_.size());
  std::vector<Sha256> hashes(columns_.size());
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Value& value = tuple.attributes[i];
    if (!value.is_defined()) continue;
    const auto about = [&](Error error) {
      return std::move(error).about(fmt::format("tuple {}: '{}'", tuple.id, columns_[i].attribute));
    };
    auto sent = sent_bytes(columns_[i].type, value);
    if (!sent) return about(std::move(sent).error());
    if (columns_[i].type.form == ColumnType::Form::small_set) {
      auto hashed = hashed_bytes(columns_[i].type, value, *sent);
      if (!hashed) return about(std::move(hashed).error());
      hashes[i] = sha256(*hashed);
    } else {
      hashes[i] = sha256(*sent);
    }
    row.fields[i] = *std::move(sent);
  }
  row.digest = row_digest(hashes);
  return row;
}

Result<RowDigest> MovedColumns::digest_of(Relation& relation, const std::atomic<bool>* cancel) const {
  RowDigest digest;
  A3D_ASSIGN(const TupleStreamPtr tuples, relation.scan());
  while (true) {
    if (cancel != nullptr && cancel->load(std::memory_order_relaxed)) return algebra3d::Monitor::interrupted();
    A3D_ASSIGN(const TuplePtr tuple, tuples->next());
    if (tuple == nullptr) return digest;
    A3D_ASSIGN(const Row row, row_of(*tuple));
    digest = digest + row.digest;
  }
}

Result<MovedColumns> columns_for(const TypeExpr& tuple_type, const ServerTable& table, const ExtensionTypes& extension,
                                 const std::string& database, const algebra3d::Registry& registry) {
  std::vector<MovedColumn> columns;
  std::set<std::string> names;
  Differences differences;
  for (const TypeExpr::Attribute& attribute : tuple_type.attributes()) {
    A3D_ASSIGN(ColumnType type, column_type_of(attribute, extension, database, registry));
    const ServerColumn* const there = column_of(table, attribute.name);
    std::string name = there != nullptr ? there->name : column_name(attribute.name);
    if (!names.insert(name).second) differences.add("two attributes would be the column {}; rename one of them", name);
    if (table.is_there && there == nullptr) differences.add("it has no column {} for '{}'", name, attribute.name);
    if (there != nullptr && !takes(*there, type))
      differences.add("its column {} is of type {}, expected {} for '{}'", name, there->type, type.sql_name,
                      attribute.name);
    columns.push_back({attribute.name, std::move(name), std::move(type)});
  }
  A3D_TRY(differences.status(fit_subject(table, {})));
  return MovedColumns(std::move(columns));
}

Result<TypeExpr> tuple_type_for(const ServerTable& table) {
  std::vector<TypeExpr::Attribute> attributes;
  std::set<std::string> names;
  Differences differences;
  for (const ServerColumn& column : table.columns) {
    const auto type = type_for_sql(column.type, column.extension_type);
    if (!type)
      differences.add(
          "its column {} is of type {}, which has no counterpart here; a materialized view can leave it out "
          "or cast it",
          column.name, column.type);
    std::string name = attribute_name(column.name);
    if (const Status named = check_object_name(name, "an attribute"); !named)
      differences.add("its column {}: {}", column.name, named.error().message);
    if (!names.insert(name).second) differences.add("two columns would be the attribute {}", name);
    attributes.push_back({std::move(name), TypeExpr(type.value_or("text"))});
  }
  if (attributes.empty()) differences.add("it has no columns");
  A3D_TRY(differences.status(fmt::format("the table {} cannot be a relation", table.text())));
  return TypeExpr::tuple(std::move(attributes));
}

Result<MovedColumns> attributes_for(const ServerTable& table, const TypeExpr& tuple_type, const std::string& relation,
                                    const ExtensionTypes& extension, const std::string& database,
                                    const algebra3d::Registry& registry) {
  std::vector<MovedColumn> columns;
  std::set<std::string> used;
  Differences differences;
  for (const TypeExpr::Attribute& attribute : tuple_type.attributes()) {
    const auto found = std::ranges::find_if(table.columns, [&](const ServerColumn& column) {
      return column.name == attribute.name || column_name(attribute_name(column.name)) == column_name(attribute.name);
    });
    if (found == table.columns.end()) {
      differences.add("it has no column for '{}'", attribute.name);
      continue;
    }
    if (!used.insert(found->name).second) differences.add("its column {} would be two attributes", found->name);
    A3D_ASSIGN(ColumnType type, column_type_of(attribute, extension, database, registry));
    const auto expected = type_for_sql(found->type, found->extension_type);
    const bool is_text = expected == "text" && attribute.type.is("string");
    if (expected != attribute.type.name() && !is_text)
      differences.add("its column {} is of type {}, but '{}' is of type {}", found->name, found->type, attribute.name,
                      attribute.type.text());
    columns.push_back({attribute.name, found->name, std::move(type)});
  }
  for (const ServerColumn& column : table.columns)
    if (!used.contains(column.name)) differences.add("the relation has no attribute for its column {}", column.name);
  A3D_TRY(differences.status(fit_subject(table, relation)));
  return MovedColumns(std::move(columns));
}

}  // namespace queries
