#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "queries/store/database.h"

namespace queries {

/// The row that `cells` hold, of which the checksum counts as NULL, appended to `bytes`. False if the checksum is
/// wrong; then nothing is appended.
bool append_proved(std::span<Cell> cells, std::string& bytes);
Error damaged_row(const RelationLayout& layout, TupleId id);

/// Reads the rows of one relation's table: proves each by its checksum, then gives boxes or a tuple.
class RowReader {
 public:
  /// What it makes of rows belongs to the running statement, read at `time`.
  RowReader(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout, ChangeTime time)
      : database_(std::move(database)), layout_(std::move(layout)), time_(time) {}

  /// Takes the row that `statement` stands on, with the small columns; valid until its next step.
  /// Errors: database_corrupt.
  Status take(const SqliteStatement& statement);
  /// Takes a row that was proved before, as `append_cells` has written it; valid while these bytes are.
  void take(std::string_view row, std::uint64_t checksum);
  TupleId id() const { return cells_[0].integer; }
  std::uint64_t checksum() const { return as_unsigned(cells_[1].integer); }
  /// Box of a spatial attribute; empty if it is undefined or empty.
  algebra3d::Box3 box(std::size_t attribute) const;
  /// One per attribute, empty ones for those that are not spatial.
  std::vector<algebra3d::Box3> boxes() const;
  /// Points or triangles of a defined spatial attribute.
  std::uint32_t size(std::size_t attribute) const;
  Result<TuplePtr> tuple() const;
  /// One value of the tuple; large ones are deferred. Errors: database_corrupt.
  Result<Value> value(std::size_t attribute) const;

 private:
  Result<Value> large_value(std::size_t attribute) const;
  Error corrupt(const AttributeColumns& attribute) const;

  std::shared_ptr<Database> database_;
  std::shared_ptr<const RelationLayout> layout_;
  ChangeTime time_;
  std::vector<Cell> cells_;
  std::string checked_;  // kept, so that no row needs a new one
};

/// What is known of a row once it is written.
struct WrittenRow {
  std::uint64_t checksum = 0;
  std::vector<algebra3d::Box3> boxes;  ///< one per attribute
};

/// A tuple made ready to be written: everything that can fail but for the writing itself has been done, and nothing is
/// read any more.
class RowWriter {
 public:
  /// Errors: those of loading deferred values; internal if the tuple is not of the relation's type.
  static Result<std::unique_ptr<RowWriter>> make(Database& database, const RelationLayout& layout, TupleId id,
                                                 const Tuple& tuple);
  Status write();
  const WrittenRow& row() const { return row_; }
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

  Database& database_;
  const RelationLayout& layout_;
  std::vector<Cell> cells_;
  std::vector<Value> values_;                          // whose texts the cells refer to
  std::vector<std::unique_ptr<std::string>> encoded_;  // to which cells refer
  std::vector<Long> long_;
  std::uint64_t inline_bytes_ = 0;
  WrittenRow row_;
};

}  // namespace queries
