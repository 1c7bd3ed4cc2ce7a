#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "queries/streams/relation.h"
#include "queries/transfer/detail/column_types.h"
#include "queries/transfer/detail/row_digest.h"
#include "queries/transfer/detail/server_table.h"

namespace queries {

/// An attribute and its column.
struct MovedColumn {
  std::string attribute;
  std::string column;
  ColumnType type;
};

/// The attributes of a relation and the columns of a table that move, in the order of the attributes.
class MovedColumns {
 public:
  MovedColumns() = default;
  explicit MovedColumns(std::vector<MovedColumn> columns) : columns_(std::move(columns)) {}

  const std::vector<MovedColumn>& all() const { return columns_; }
  std::size_t size() const { return columns_.size(); }

  /// "a", "b"
  std::string names_sql() const;
  /// "a" bigint, "b" "public"."volume3d"
  std::string definitions_sql() const;
  /// The expressions that COPY sends.
  std::string sent_sql() const;
  /// Count and checksum of the rows of a table, as on the server when it is asked. `condition` may be empty.
  Result<RowDigest> digest_of(ServerConnection& connection, const ServerTable& table,
                              const std::string& condition = {}) const;

  /// A row as COPY sends it, and its digest.
  struct Row {
    std::vector<std::optional<std::string>> fields;
    RowDigest digest;
  };
  /// Errors: name the tuple and the attribute.
  Result<Row> row_of(const Tuple& tuple) const;
  /// Adds a tuple's digest to those of a relation. Reports each tuple, and ends when `cancel` is set.
  Result<RowDigest> digest_of(Relation& relation, const std::atomic<bool>* cancel) const;

 private:
  std::vector<MovedColumn> columns_;
};

/// The column for an attribute, where a table has none yet: the name in lower case, as psql takes it without quotes.
std::string column_name(std::string_view attribute);
/// The attribute for a column, where a relation has none yet: the name with a capital, and `_` for characters that a
/// name cannot have.
std::string attribute_name(std::string_view column);

/// The columns for the attributes of a relation: those of the table, if it is there, which may have others, too; else
/// those that it is to get. A column belongs to an attribute if it has its name, or its name in lower case. Errors:
/// type_error that lists all that does not fit.
Result<MovedColumns> columns_for(const TypeExpr& tuple_type, const ServerTable& table, const ExtensionTypes& extension,
                                 const std::string& database, const algebra3d::Registry& registry);

/// The tuple type for the columns of a table: type_error for a column whose type has no counterpart.
Result<TypeExpr> tuple_type_for(const ServerTable& table);
/// The columns of a table for the attributes of a relation, of which each must have one, and the other way round.
/// Errors: type_error that lists all that does not fit.
Result<MovedColumns> attributes_for(const ServerTable& table, const TypeExpr& tuple_type, const std::string& relation,
                                    const ExtensionTypes& extension, const std::string& database,
                                    const algebra3d::Registry& registry);

}  // namespace queries
