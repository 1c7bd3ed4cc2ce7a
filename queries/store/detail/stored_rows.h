#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "queries/store/detail/database.h"

namespace queries {

/// Checks the checksum of the row in `cells` and appends the row to `bytes`, with NULL in place of the checksum. False
/// if the checksum is wrong; then nothing is appended.
bool append_proved(std::span<Cell> cells, std::string& bytes);
Error damaged_row(const RelationLayout& layout, TupleId id);

/// Reads rows of a relation's table: verifies each by its checksum, then returns boxes or a tuple.
class RowReader {
 public:
  /// `time`: when the rows are read. Tuples made from them are valid in the running statement.
  RowReader(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout, ChangeTime time)
      : database_(std::move(database)), layout_(std::move(layout)), time_(time) {}

  /// Takes a copy of the small columns of the current row of `statement`. Errors: database_corrupt.
  Status take(const SqliteStatement& statement);
  /// Takes a verified row in the form of `append_cells`; valid as long as these bytes.
  void take(std::string_view row, std::uint64_t checksum);
  /// Begins a row of which only some cells are known: those that `set_cell` sets, which the caller vouches for.
  void name_row(const Cell& id, const Cell& checksum) {
    cells_.resize(layout_->small_column_count());
    cells_[0] = id;
    cells_[1] = checksum;
  }
  void set_cell(std::size_t column, const Cell& cell) { cells_[column] = cell; }
  TupleId id() const { return cells_[0].integer; }
  std::uint64_t checksum() const { return as_unsigned(cells_[1].integer); }
  /// Box of a spatial attribute; empty if the value is undefined or empty.
  algebra3d::Box3 box(std::size_t attribute) const;
  /// Boxes of all attributes; empty for those that are not spatial.
  std::vector<algebra3d::Box3> boxes() const;
  /// Number of points or triangles of a defined spatial attribute.
  std::uint32_t size(std::size_t attribute) const;
  /// The cells of all small columns.
  std::span<const Cell> cells() const { return cells_; }
  Result<TuplePtr> tuple() const;
  /// An attribute value; large ones are deferred. Errors: database_corrupt.
  Result<Value> value(std::size_t attribute) const;
  /// The error for a cell that is not a value of the attribute.
  Error corrupt(const AttributeColumns& attribute) const;

 private:
  Result<Value> large_value(std::size_t attribute) const;

  std::shared_ptr<Database> database_;
  std::shared_ptr<const RelationLayout> layout_;
  ChangeTime time_;
  std::vector<Cell> cells_;
  std::string checked_;  // reused for all rows
};

/// The cell of a defined value in the column of an attribute with a native order. It refers to the value's text.
Cell native_cell(AttributeForm form, const Value& value);

/// Properties of a row that has been written.
struct WrittenRow {
  std::uint64_t checksum = 0;
  std::vector<algebra3d::Box3> boxes;  ///< one per attribute
};

/// A tuple prepared for writing: its values are encoded, so only the writing itself can still fail.
class RowWriter {
 public:
  /// `old`: the row that is to be overwritten, if there is one. It must live as long as the writer; of its large
  /// values, those that stay are neither read nor encoded. Errors: those of loading deferred values; internal if the
  /// tuple is not of the relation's type.
  static Result<std::unique_ptr<RowWriter>> make(Database& database, const RelationLayout& layout, TupleId id,
                                                 const Tuple& tuple, const RowReader* old = nullptr);
  /// Writes a new row.
  Status write();
  /// Writes into the old row what differs from it.
  Status overwrite();
  const WrittenRow& row() const { return row_; }
  /// All cells of the row.
  std::span<Cell> cells() { return cells_; }
  const std::vector<Value>& values() const { return values_; }
  const Value& value(std::size_t attribute) const { return values_[attribute]; }

 private:
  struct Long {
    std::size_t attribute;
    std::string_view bytes;
  };

  RowWriter(Database& database, const RelationLayout& layout) : database_(database), layout_(layout) {}
  Status add(std::size_t attribute, const Value& value);
  Status add_bytes(std::size_t attribute, const Value& value);
  void add_header(const AttributeColumns& columns, const algebra3d::GeometryHeader& header);
  void place_bytes(std::size_t attribute, std::string_view bytes);
  bool is_in_old_row(std::size_t attribute, const Value& value) const;
  Status write_long();

  Database& database_;
  const RelationLayout& layout_;
  std::vector<Cell> cells_;
  std::vector<Value> values_;                          // the cells refer to their texts
  std::vector<std::unique_ptr<std::string>> encoded_;  // the cells refer to them
  std::vector<Long> long_;
  const RowReader* old_ = nullptr;
  std::vector<std::size_t> changed_large_;  // attributes whose bytes differ from those of the old row
  std::uint64_t inline_bytes_ = 0;
  WrittenRow row_;
};

}  // namespace queries
