#include "queries/store/detail/row_columns.h"

#include <algorithm>
#include <numeric>

#include "base/propagate.h"

namespace queries {
namespace {

/// A page ends early when texts and small values fill it.
constexpr std::size_t kPageBytes = std::size_t{4} << 20;

/// Whether a cell is what a defined value of a number, truth value or string is stored as.
bool is_native(AttributeForm form, const Cell& cell) {
  switch (form) {
    case AttributeForm::integer:
      return cell.is(Cell::Kind::integer);
    case AttributeForm::boolean:
      return cell.is(Cell::Kind::integer) && (cell.integer == 0 || cell.integer == 1);
    case AttributeForm::real:
      return cell.is(Cell::Kind::real);
    default:
      return cell.is(Cell::Kind::text);
  }
}

}  // namespace

RowColumns::RowColumns(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout,
                       const std::vector<bool>& read, bool proves_rows, ChangeTime time)
    : layout_(layout), proves_rows_(proves_rows), reader_(std::move(database), std::move(layout), time) {
  cells_ = {0, 1};
  if (proves_rows_) {
    cells_.resize(layout_->small_column_count());
    std::iota(cells_.begin(), cells_.end(), std::size_t{0});
  }
  const auto& attributes = layout_->attributes();
  read_.reserve(attributes.size());  // the batch refers to its columns
  for (std::size_t attribute = 0; attribute < attributes.size(); ++attribute) {
    const AttributeColumns& columns = attributes[attribute];
    if (read[attribute]) {
      read_.push_back({attribute, add_cells(columns), ValueColumn(*columns.type)});
      batch_.columns.push_back(&read_.back().column);
    } else {
      unread_.push_back(std::make_unique<ValueColumn>(*columns.type));
      batch_.columns.push_back(unread_.back().get());
    }
  }
}

/// Adds the cells of an attribute to those of a row; the place of the first.
std::size_t RowColumns::add_cells(const AttributeColumns& columns) {
  const bool is_large = columns.form == AttributeForm::large;
  const std::size_t first = is_large ? columns.box : columns.value;
  if (proves_rows_) return first;
  const std::size_t place = cells_.size();
  for (std::size_t cell = first; cell <= first + (is_large ? kSumAfterBox : 0); ++cell) cells_.push_back(cell);
  return place;
}

void RowColumns::restart(TupleId after, std::size_t most) {
  ids_.clear();
  checksums_.clear();
  is_whole_ = true;
  for (ReadAttribute& each : read_) each.column.restart(most);
  most_ = most;
  text_bytes_ = 0;
  last_ = after;
  taken_status_ = {};
}

bool RowColumns::is_full() const {
  return ids_.size() >= most_ || text_bytes_ >= kPageBytes;
}

bool RowColumns::take(std::span<Cell> row) {
  const TupleId id = row[0].integer;
  if (proves_rows_) proved_.clear();
  if (proves_rows_ ? !append_proved(row, proved_) : !row[1].is(Cell::Kind::integer)) {
    taken_status_ = damaged_row(*layout_, id);
    return true;
  }
  if (id <= last_) {
    // A damaged tree could lead round in circles.
    taken_status_ = Error{ErrorCode::database_corrupt, "the tuples are not in order"}.about(layout_->relation());
    return true;
  }
  const std::size_t place = ids_.size();
  ids_.push_back(id);
  checksums_.push_back(as_unsigned(row[1].integer));
  last_ = id;
  reader_.name_row(row[0], row[1]);
  for (ReadAttribute& each : read_) {
    taken_status_ = put(each, row, place);
    if (!taken_status_.ok()) return true;
  }
  return is_full();
}

Status RowColumns::put(ReadAttribute& read, std::span<const Cell> row, std::size_t place) {
  const AttributeColumns& columns = layout_->attributes()[read.attribute];
  const Cell& cell = row[read.cell];
  if (!columns.has_native_order() || columns.form == AttributeForm::text) {
    const bool is_large = columns.form == AttributeForm::large;
    const std::size_t first = is_large ? columns.box : columns.value;
    for (std::size_t i = 0; i <= (is_large ? kSumAfterBox : 0); ++i) reader_.set_cell(first + i, row[read.cell + i]);
    text_bytes_ += cell.bytes.size();
    return put_from_reader(read, place);
  }
  if (cell.is_null()) {
    read.column.set_undefined(place);
    return {};
  }
  if (!is_native(columns.form, cell)) return reader_.corrupt(columns);
  if (columns.form == AttributeForm::integer && read.column.holds<std::int64_t>()) {
    read.column.data<std::int64_t>()[place] = cell.integer;
  } else if (columns.form == AttributeForm::real && read.column.holds<double>()) {
    read.column.data<double>()[place] = cell.real;
  } else if (columns.form == AttributeForm::boolean) {
    read.column.data<bool>()[place] = cell.integer == 1 ? 1 : 0;
  } else if (columns.form == AttributeForm::string && read.column.holds<std::string>()) {
    read.column.data<std::string>()[place].assign(cell.bytes);
    text_bytes_ += cell.bytes.size();
  } else {
    reader_.set_cell(columns.value, cell);
    return put_from_reader(read, place);
  }
  return {};
}

Status RowColumns::put_from_reader(ReadAttribute& read, std::size_t place) {
  A3D_ASSIGN(const Value value, reader_.value(read.attribute));
  read.column.set(place, value);
  return {};
}

std::vector<std::size_t> RowColumns::attributes() const {
  std::vector<std::size_t> result;
  for (const ReadAttribute& each : read_) result.push_back(each.attribute);
  return result;
}

// The checksum of the group stands for all of its rows.
Status RowColumns::take_group(const RowGroup& group, const std::vector<std::shared_ptr<const ColumnChunk>>& chunks,
                              std::size_t first, std::size_t count) {
  const GroupContent& content = *group.content;
  ids_.resize(count);
  for (std::size_t place = 0; place < count; ++place) ids_[place] = content.id(first + place);
  checksums_.assign(count, 0);
  last_ = ids_.back();
  for (std::size_t i = 0; i < read_.size(); ++i) A3D_TRY(chunks[i]->read(first, count, read_[i].column));
  if (group.dead_count == 0) return {};
  is_whole_ = false;
  positions_.clear();
  for (std::size_t place = 0; place < count; ++place)
    if (!group.is_dead(first + place)) positions_.push_back(static_cast<std::uint32_t>(place));
  return {};
}

void RowColumns::begin_beside(std::size_t count, TupleId after) {
  group_rows_ = ids_.size();
  most_ = group_rows_ + count;
  last_ = after;
  for (ReadAttribute& each : read_) each.column.grow(most_);
}

bool RowColumns::end_beside(const std::vector<TupleId>& ids) {
  const auto begin = ids_.begin() + static_cast<std::ptrdiff_t>(group_rows_);
  if (!std::ranges::equal(std::ranges::subrange(begin, ids_.end()), ids)) return false;
  const auto middle = static_cast<std::ptrdiff_t>(positions_.size());
  for (std::size_t place = group_rows_; place < ids_.size(); ++place)
    positions_.push_back(static_cast<std::uint32_t>(place));
  std::ranges::inplace_merge(positions_, positions_.begin() + middle, {},
                             [&](std::uint32_t place) { return ids_[place]; });
  return true;
}

void RowColumns::take_none() {
  is_whole_ = false;
  positions_.clear();
}

void RowColumns::erase(const std::vector<TupleId>& ids) {
  is_whole_ = false;
  positions_.clear();
  for (std::size_t place = 0; place < ids_.size(); ++place)
    if (!std::ranges::binary_search(ids, ids_[place])) positions_.push_back(static_cast<std::uint32_t>(place));
}

Status RowColumns::add_from_reader() {
  const std::size_t place = ids_.size();
  positions_.push_back(static_cast<std::uint32_t>(place));
  ids_.push_back(reader_.id());
  checksums_.push_back(reader_.checksum());
  for (ReadAttribute& each : read_) {
    each.column.grow(place + 1);
    A3D_TRY(put_from_reader(each, place));
  }
  return {};
}

void RowColumns::order_rows() {
  std::ranges::sort(positions_, {}, [&](std::uint32_t place) { return ids_[place]; });
}

void RowColumns::finish() {
  batch_.size = ids_.size();
  batch_.ids = ids_.data();
  batch_.rows = is_whole_ ? SelectedRows{nullptr, ids_.size()} : SelectedRows{positions_.data(), positions_.size()};
}

std::uint64_t RowColumns::sum() const {
  std::uint64_t result = 0;
  batch_.rows.for_each([&](std::size_t place) { result += checksums_[place]; });
  return result;
}

const Batch& RowColumns::rest(std::size_t first) {
  std::vector<std::uint32_t> rows;
  for (std::size_t i = first; i < batch_.rows.count; ++i) rows.push_back(static_cast<std::uint32_t>(batch_.rows[i]));
  positions_ = std::move(rows);
  is_whole_ = false;
  batch_.rows = {positions_.data(), positions_.size()};
  return batch_;
}

}  // namespace queries
