#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "algebra3d/values/types/type_expr.h"

namespace queries {

/// The representation of an attribute in the columns of its relation's table.
enum class AttributeForm : std::uint8_t {
  integer,
  boolean,
  real,
  string,
  text,
  bytes,    ///< encoded, read with the row
  spatial,  ///< as bytes, with box and size in further columns
  large,    ///< as spatial, but the bytes are read on demand; the row has their checksum
};

/// An attribute and its columns, counted from 0 in the table.
struct AttributeColumns {
  std::string name;
  const algebra3d::Type* type = nullptr;
  AttributeForm form = AttributeForm::bytes;
  std::size_t value = 0;        ///< column of the native value or the encoded bytes
  std::string keys_table = {};  ///< name of the key table of an ordered index
  std::size_t box = 0;          ///< first of the columns min x, y, z, max x, y, z, size; for `large` also the checksum

  bool has_box() const { return form == AttributeForm::spatial || form == AttributeForm::large; }
  /// True if SQLite orders the column as the language orders the values: numbers, truth values and texts.
  bool has_native_order() const {
    return form == AttributeForm::integer || form == AttributeForm::boolean || form == AttributeForm::real ||
           form == AttributeForm::string || form == AttributeForm::text;
  }
};

/// Offset of the size column from `AttributeColumns::box`.
inline constexpr std::size_t kSizeAfterBox = 6;
inline constexpr std::size_t kSumAfterBox = 7;

/// The columns of a relation's table: tuple id, checksum of the row, numbers, boxes, texts, small and then large
/// encoded values. Columns that filters read come before the large values. Immutable.
class RelationLayout {
 public:
  /// Errors: type_error for an attribute that cannot be stored, limit_exceeded for too many of them.
  static algebra3d::Result<std::shared_ptr<const RelationLayout>> make(const algebra3d::Registry& registry,
                                                                       const algebra3d::TypeExpr& tuple,
                                                                       const std::string& relation,
                                                                       std::int64_t table_number);

  const std::string& relation() const { return relation_; }
  std::int64_t table_number() const { return table_number_; }
  const algebra3d::TypeExpr& tuple_type() const { return tuple_; }
  const std::vector<AttributeColumns>& attributes() const { return attributes_; }
  /// Index of the attribute of that name; of `attributes().size()` if there is none.
  std::size_t find(const std::string& attribute) const;

  /// Whether tuples may stand in row groups: no attribute is large.
  bool has_columns() const;

  std::size_t column_count() const { return columns_.size(); }
  /// Number of columns before the large ones: they are read with the row, and the row's checksum covers them.
  std::size_t small_column_count() const { return small_count_; }

  // SQL statements; the comment behind names their parameters.
  std::string create_sql() const;
  std::string drop_sql() const { return "DROP TABLE " + table_; }
  /// Renames the table to the name in `renamed`, the layout of the renamed relation. Empty if the names are equal.
  std::string rename_sql(const RelationLayout& renamed) const;
  const std::string& table() const { return table_; }
  const std::string& insert_sql() const { return insert_sql_; }  ///< all columns
  /// Overwrites these columns: their values, id.
  std::string update_sql(std::span<const std::size_t> columns) const;
  const std::string& erase_sql() const { return erase_sql_; }  ///< id
  /// Passes these columns to a RowSink: id > first, id <= second, sink. If they are too many for that, it returns them:
  /// id > first, id <= second, limit.
  std::string page_sql(std::span<const std::size_t> columns) const;
  std::string ids_sql() const;                                 ///< the ids: id >= first, id <= second
  const std::string& range_sql() const { return range_sql_; }  ///< the small columns: id >= first, id <= second
  std::string erase_range_sql() const;                         ///< id >= first, id <= second
  const std::string& tail_sql() const { return tail_sql_; }    ///< id >= first, limit
  const std::string& fetch_sql() const { return fetch_sql_; }  ///< id
  std::string bytes_sql(std::size_t attribute) const;          ///< id
  const std::string& column(std::size_t index) const { return columns_[index]; }

  // SQLite's index on the keys of an attribute with a native order: the stored form of an ordered index. It is on the
  // column of the relation's table or, if tuples may stand in row groups, on the key table of the attribute.
  enum class OrderOn : bool { table, keys };
  std::string order_name(std::size_t attribute) const;
  const std::string& order_table(std::size_t attribute, OrderOn on) const;
  const std::string& order_column(std::size_t attribute, OrderOn on) const;
  std::string create_order_sql(std::size_t attribute, OrderOn on) const;
  std::string drop_order_sql(std::size_t attribute) const;  ///< does nothing if there is none

  // The key table of an attribute: docs/file_format.md.
  const std::string& keys_table(std::size_t attribute) const { return attributes_[attribute].keys_table; }
  std::string create_keys_sql(std::size_t attribute) const;
  std::string fill_keys_sql(std::size_t attribute) const;   ///< from the relation's table
  std::string drop_keys_sql(std::size_t attribute) const;   ///< does nothing without such a table
  std::string insert_key_sql(std::size_t attribute) const;  ///< id, key
  std::string update_key_sql(std::size_t attribute) const;  ///< key, id
  std::string erase_key_sql(std::size_t attribute) const;   ///< id
  std::string row_sql() const { return "SELECT * FROM " + table_ + " WHERE id = ?"; }  ///< id; all columns

 private:
  RelationLayout() = default;
  void add_columns();
  void add_statements();
  std::size_t add_column(std::string name, std::string_view sql_type);

  std::string relation_;
  std::int64_t table_number_ = 0;
  algebra3d::TypeExpr tuple_;
  std::vector<AttributeColumns> attributes_;
  std::string table_;
  std::vector<std::string> columns_;
  std::vector<std::string> column_types_;
  std::size_t small_count_ = 0;
  std::string insert_sql_, erase_sql_, tail_sql_, range_sql_, fetch_sql_;
};

}  // namespace queries
