#include "queries/store/detail/stored_rows.h"

#include <bit>
#include <cassert>
#include <limits>
#include <span>

#include "algebra3d/values/types/codec.h"
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"
#include "queries/store/detail/chunks.h"
#include "queries/store/detail/formed_value.h"
#include "queries/store/detail/stored_value.h"

namespace queries {
namespace {

using algebra3d::Box3;
using algebra3d::GeometryHeader;
using Kind = Cell::Kind;

constexpr std::size_t kChecksumColumn = 1;

/// Over the id and all small columns but the checksum itself, which counts as NULL.
std::uint64_t row_checksum(const RelationLayout& layout, std::vector<Cell>& cells) {
  const Cell checksum = std::exchange(cells[kChecksumColumn], Cell());
  const std::uint64_t result = checksum_of(std::span(cells).first(layout.small_column_count()));
  cells[kChecksumColumn] = checksum;
  return result;
}

/// The encoded bytes of a defined value; a value that our own database defers is not decoded for this, nor is one
/// encoded that has its binary form.
Result<std::string> encoded_bytes(const Database& database, const Value& value) {
  if (const auto deferred = value.deferred()) {
    const auto* stored = dynamic_cast<const StoredValue*>(deferred.get());
    if (stored != nullptr && stored->database() == &database) return stored->encoded();
    if (const auto* formed = dynamic_cast<const FormedValue*>(deferred.get())) return formed->form();
  }
  A3D_ASSIGN(const Value loaded, value.loaded());
  return algebra3d::encode_to_store(loaded);
}

}  // namespace

Error RowReader::corrupt(const AttributeColumns& attribute) const {
  return Error{ErrorCode::database_corrupt, "'{}' is not a value of type {}", attribute.name, attribute.type->name()}
      .about(fmt::format("tuple {}", id()))
      .about(layout_->relation());
}

Error damaged_row(const RelationLayout& layout, TupleId id) {
  return Error{ErrorCode::database_corrupt, "the row of tuple {} is not what was written", id}.about(layout.relation());
}

bool append_proved(std::span<Cell> cells, std::string& bytes) {
  const Cell checksum = std::exchange(cells[kChecksumColumn], Cell());
  const std::size_t begin = bytes.size();
  append_cells(cells, bytes);
  cells[kChecksumColumn] = checksum;
  if (checksum.is(Kind::integer) && checksum_of(std::string_view(bytes).substr(begin)) == as_unsigned(checksum.integer))
    return true;
  bytes.resize(begin);
  return false;
}

Status RowReader::take(const SqliteStatement& statement) {
  cells_.resize(layout_->small_column_count());
  statement.read_columns(cells_);
  checked_.clear();
  if (!append_proved(cells_, checked_)) return damaged_row(*layout_, id());
  take(checked_, checksum());
  return {};
}

void RowReader::take(std::string_view row, std::uint64_t checksum) {
  cells_.resize(layout_->small_column_count());
  take_cells(row, cells_);
  cells_[kChecksumColumn] = Cell::of(as_signed(checksum));
}

Box3 RowReader::box(std::size_t attribute) const {
  const AttributeColumns& columns = layout_->attributes()[attribute];
  Box3 box;
  if (!columns.has_box() || !cells_[columns.box].is(Kind::real)) return box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = cells_[columns.box + axis].real;
    box.max[axis] = cells_[columns.box + 3 + axis].real;
  }
  return box;
}

std::uint32_t RowReader::size(std::size_t attribute) const {
  return static_cast<std::uint32_t>(cells_[layout_->attributes()[attribute].box + kSizeAfterBox].integer);
}

std::vector<Box3> RowReader::boxes() const {
  std::vector<Box3> result;
  for (std::size_t i = 0; i < layout_->attributes().size(); ++i) result.push_back(box(i));
  return result;
}

Result<TuplePtr> RowReader::tuple() const {
  auto tuple = std::make_shared<Tuple>();
  tuple->id = id();
  tuple->attributes.reserve(layout_->attributes().size());
  for (std::size_t i = 0; i < layout_->attributes().size(); ++i) {
    A3D_ASSIGN(Value next, value(i));
    tuple->attributes.push_back(std::move(next));
  }
  return TuplePtr(std::move(tuple));
}

Result<Value> RowReader::large_value(std::size_t attribute) const {
  const AttributeColumns& columns = layout_->attributes()[attribute];
  const Cell& size = cells_[columns.box + kSizeAfterBox];
  const Cell& sum = cells_[columns.box + kSumAfterBox];
  if (size.is_null()) return Value(*columns.type);
  if (!size.is(Kind::integer) || !sum.is(Kind::integer)) return corrupt(columns);
  LargeValue large{.layout = layout_,
                   .tuple = id(),
                   .attribute = attribute,
                   .header = {box(attribute), static_cast<std::uint32_t>(size.integer)},
                   .checksum = as_unsigned(sum.integer),
                   .statement = database_->statement(),
                   .time = time_};
  return Value(*columns.type, std::make_shared<StoredValue>(database_, std::move(large)));
}

Result<Value> RowReader::value(std::size_t attribute) const {
  const AttributeColumns& columns = layout_->attributes()[attribute];
  if (columns.form == AttributeForm::large) return large_value(attribute);
  const Cell& cell = cells_[columns.value];
  if (cell.is_null()) return Value(*columns.type);
  switch (columns.form) {
    case AttributeForm::integer:
      if (!cell.is(Kind::integer)) break;
      return Value::of(cell.integer);
    case AttributeForm::boolean:
      if (!cell.is(Kind::integer) || (cell.integer != 0 && cell.integer != 1)) break;
      return Value::of(cell.integer == 1);
    case AttributeForm::real:
      if (!cell.is(Kind::real)) break;
      return Value::of(cell.real);
    case AttributeForm::string:
      if (!cell.is(Kind::text)) break;
      return Value::of(std::string(cell.bytes));
    case AttributeForm::text:
      if (!cell.is(Kind::text)) break;
      return Value::of(algebra3d::Text{std::string(cell.bytes)});
    case AttributeForm::bytes:
    case AttributeForm::spatial:
    case AttributeForm::large:
      if (!cell.is(Kind::blob)) break;
      return algebra3d::decode(*columns.type, cell.bytes, algebra3d::Origin::own_store);
  }
  return corrupt(columns);
}

Cell native_cell(AttributeForm form, const Value& value) {
  switch (form) {
    case AttributeForm::integer:
      return Cell::of(value.get<std::int64_t>());
    case AttributeForm::boolean:
      return Cell::of(std::int64_t{value.get<bool>()});
    case AttributeForm::real:
      return Cell::of(value.get<double>());
    case AttributeForm::string:
      return Cell::text(value.get<std::string>());
    case AttributeForm::text:
      return Cell::text(value.get<algebra3d::Text>().content);
    case AttributeForm::bytes:
    case AttributeForm::spatial:
    case AttributeForm::large:
      break;
  }
  assert(false && "an attribute without a native order");
  return {};
}

Result<std::unique_ptr<RowWriter>> RowWriter::make(Database& database, const RelationLayout& layout, TupleId id,
                                                   const Tuple& tuple, const RowReader* old) {
  const auto& attributes = layout.attributes();
  if (tuple.attributes.size() != attributes.size())
    return Error{ErrorCode::internal, "a tuple of {} attributes, expected {}", tuple.attributes.size(),
                 attributes.size()}
        .about(layout.relation());
  std::unique_ptr<RowWriter> writer(new RowWriter(database, layout));
  writer->old_ = old;
  writer->cells_.resize(layout.column_count());
  writer->row_.boxes.resize(attributes.size());
  writer->values_ = tuple.attributes;
  writer->cells_[0] = Cell::of(id);
  for (std::size_t i = 0; i < attributes.size(); ++i) A3D_TRY(writer->add(i, writer->values_[i]));
  writer->row_.checksum = row_checksum(layout, writer->cells_);
  writer->cells_[kChecksumColumn] = Cell::of(as_signed(writer->row_.checksum));
  return writer;
}

Status RowWriter::add(std::size_t attribute, const Value& value) {
  const AttributeColumns& columns = layout_.attributes()[attribute];
  if (&value.type() != columns.type)
    return Error{ErrorCode::internal, "a value of type {} for '{}', expected {}", value.type().term().text(),
                 columns.name, columns.type->term().text()}
        .about(layout_.relation());
  if (!value.is_defined()) {
    const bool was_defined =
        old_ != nullptr && columns.has_box() && !old_->cells()[columns.box + kSizeAfterBox].is_null();
    if (was_defined && columns.form == AttributeForm::large) changed_large_.push_back(attribute);
    return {};
  }
  if (!columns.has_native_order()) return add_bytes(attribute, value);
  cells_[columns.value] = native_cell(columns.form, value);
  return {};
}

Status RowWriter::add_bytes(std::size_t attribute, const Value& value) {
  const AttributeColumns& columns = layout_.attributes()[attribute];
  if (columns.has_box()) {
    const GeometryHeader header = value.header();
    row_.boxes[attribute] = header.box;
    add_header(columns, header);
  }
  if (is_in_old_row(attribute, value)) {
    cells_[columns.box + kSumAfterBox] = old_->cells()[columns.box + kSumAfterBox];
    return {};
  }
  A3D_ASSIGN(std::string bytes, encoded_bytes(database_, value));
  encoded_.push_back(std::make_unique<std::string>(std::move(bytes)));
  if (columns.form == AttributeForm::large) {
    const std::size_t sum = columns.box + kSumAfterBox;
    cells_[sum] = Cell::of(as_signed(checksum_of(*encoded_.back())));
    if (old_ != nullptr && are_same(cells_[sum], old_->cells()[sum])) return {};
    changed_large_.push_back(attribute);
  }
  place_bytes(attribute, *encoded_.back());
  return {};
}

/// Whether a large value is one that was read from the old row, and is still there.
bool RowWriter::is_in_old_row(std::size_t attribute, const Value& value) const {
  const AttributeColumns& columns = layout_.attributes()[attribute];
  const auto deferred = value.deferred();
  if (old_ == nullptr || columns.form != AttributeForm::large || deferred == nullptr) return false;
  const auto* stored = dynamic_cast<const StoredValue*>(deferred.get());
  if (stored == nullptr || stored->database() != &database_) return false;
  const LargeValue& place = stored->place();
  const Cell& sum = old_->cells()[columns.box + kSumAfterBox];
  return place.layout->table_number() == layout_.table_number() && place.tuple == old_->id() &&
         place.attribute == attribute && sum.is(Kind::integer) && as_unsigned(sum.integer) == place.checksum;
}

void RowWriter::add_header(const AttributeColumns& columns, const GeometryHeader& header) {
  cells_[columns.box + kSizeAfterBox] = Cell::of(std::int64_t{header.size});
  if (header.box.is_empty()) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cells_[columns.box + axis] = Cell::of(header.box.min[axis]);
    cells_[columns.box + 3 + axis] = Cell::of(header.box.max[axis]);
  }
}

// Bytes that do not fit into the row are stored beside it; its place in the row then holds the number of bytes.
void RowWriter::place_bytes(std::size_t attribute, std::string_view bytes) {
  const AttributeColumns& columns = layout_.attributes()[attribute];
  if (columns.form == AttributeForm::large && inline_bytes_ + bytes.size() > database_.options().inline_bytes) {
    cells_[columns.value] = Cell::of(static_cast<std::int64_t>(bytes.size()));
    long_.push_back({attribute, bytes});
    return;
  }
  inline_bytes_ += bytes.size();
  cells_[columns.value] = Cell::blob(bytes);
}

Status RowWriter::write() {
  SqliteConnection& connection = database_.connection();
  A3D_ASSIGN(SqliteStatement statement, connection.use(layout_.insert_sql()));
  for (std::size_t i = 0; i < cells_.size(); ++i) statement.bind(static_cast<int>(i) + 1, cells_[i]);
  A3D_TRY(statement.run());
  return write_long();
}

Status RowWriter::write_long() {
  for (const auto& [attribute, bytes] : long_) {
    const ChunkPlace place{layout_.table_number(), cells_[0].integer, static_cast<std::int64_t>(attribute)};
    A3D_TRY(write_chunks(database_.connection(), place, bytes, database_.options().chunk_bytes));
  }
  return {};
}

// SQLite writes the entries of its indexes again for each column that is named, so that only those that differ are.
Status RowWriter::overwrite() {
  std::vector<std::size_t> columns;
  for (std::size_t column = 1; column < layout_.small_column_count(); ++column)
    if (!are_same(cells_[column], old_->cells()[column])) columns.push_back(column);
  for (const std::size_t attribute : changed_large_) columns.push_back(layout_.attributes()[attribute].value);
  if (columns.empty()) return {};
  SqliteConnection& connection = database_.connection();
  for (const std::size_t attribute : changed_large_) {
    const ChunkPlace place{layout_.table_number(), cells_[0].integer, static_cast<std::int64_t>(attribute)};
    A3D_TRY(erase_chunks(connection, place));
  }
  A3D_ASSIGN(SqliteStatement statement, connection.use(layout_.update_sql(columns)));
  int parameter = 0;
  for (const std::size_t column : columns) statement.bind(++parameter, cells_[column]);
  statement.bind(++parameter, cells_[0]);
  A3D_TRY(statement.run());
  return write_long();
}

}  // namespace queries
