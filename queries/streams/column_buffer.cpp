#include "queries/streams/column_buffer.h"

#include <limits>
#include <type_traits>

#include "algebra3d/values/types/order_prefix.h"
#include "algebra3d/values/types/scalars.h"

namespace queries {
namespace {

std::uint64_t prefix_of(const Value& value) {
  return algebra3d::order_prefix(value);
}
std::uint64_t prefix_of(std::uint8_t truth) {
  return algebra3d::order_prefix_of(truth != 0);
}
template <typename Element>
std::uint64_t prefix_of(const Element& element) {
  return algebra3d::order_prefix_of(element);
}

std::strong_ordering compare_elements(double a, double b) {
  return prefix_of(a) <=> prefix_of(b);
}
std::strong_ordering compare_elements(const Value& a, const Value& b) {
  return algebra3d::compare(a, b);
}
template <typename Element>
std::strong_ordering compare_elements(const Element& a, const Element& b) {
  return a <=> b;
}

std::size_t heap_bytes_of_element(const std::string& characters) {
  constexpr std::size_t kWithinObject = 15, kBlock = 16;
  return characters.size() > kWithinObject ? characters.size() + kBlock : 0;
}
std::size_t heap_bytes_of_element(const Value& value) {
  return algebra3d::heap_bytes(value);
}
template <typename Element>
std::size_t heap_bytes_of_element(const Element& /*number*/) {
  return 0;
}

}  // namespace

void append_prefixes(const ValueColumn& column, const SelectedRows& rows, std::vector<std::uint64_t>& prefixes) {
  column.visit([&](const auto* values) {
    rows.for_each([&](std::size_t row) { prefixes.push_back(column.is_defined(row) ? prefix_of(values[row]) : 0); });
  });
}

ColumnBuffer::Column::Column(const algebra3d::Type& of) : type(&of) {
  using algebra3d::TypeOf;
  if (type == &TypeOf<std::int64_t>::type())
    content = Chunks<std::int64_t>();
  else if (type == &TypeOf<double>::type())
    content = Chunks<double>();
  else if (type == &TypeOf<bool>::type())
    content = Chunks<std::uint8_t>();
  else if (type == &TypeOf<std::string>::type())
    content = Chunks<std::string>();
  else
    content = Chunks<Value>();
}

void ColumnBuffer::Column::set_undefined(std::size_t place) {
  if (undefined.size() <= place) undefined.resize(place + 1);
  undefined[place] = 1;
}

Value ColumnBuffer::Column::value(std::size_t place) const {
  if (!is_defined(place)) return Value(*type);
  return std::visit(
      [&]<typename Element>(const Chunks<Element>& array) -> Value {
        if constexpr (std::is_same_v<Element, Value>)
          return array[place];
        else if constexpr (std::is_same_v<Element, std::uint8_t>)
          return Value::of<bool>(array[place] != 0);
        else
          return Value::of<Element>(array[place]);
      },
      content);
}

void ColumnBuffer::add(const Batch& batch) {
  if (columns_.empty()) {
    columns_.reserve(batch.columns.size());
    for (const ValueColumn* const column : batch.columns) columns_.emplace_back(column->type());
  }
  for (std::size_t attribute = 0; attribute < columns_.size(); ++attribute)
    add_to(columns_[attribute], *batch.columns[attribute], batch.rows);
  if (batch.ids != nullptr) {
    ids_.resize(size_);
    batch.rows.for_each([&](std::size_t row) { ids_.push_back(batch.ids[row]); });
  }
  size_ += batch.rows.count;
  charge();
}

void ColumnBuffer::add_to(Column& column, const ValueColumn& from, const SelectedRows& rows) {
  if (from.size() == 0 && !column.is_read) return;
  if (!column.is_read) column.undefined.assign(size_, 1);
  column.is_read = true;
  std::visit(
      [&]<typename Element>(Chunks<Element>& array) {
        const Element fill = [&] {
          if constexpr (std::is_same_v<Element, Value>)
            return Value(*column.type);
          else
            return Element();
        }();
        array_bytes_ += array.reserve(size_ + rows.count, fill);
        from.visit([&]<typename Given>(const Given* values) {
          if constexpr (std::is_same_v<Given, Element>) {
            std::size_t place = size_;
            rows.for_each([&](std::size_t row) {
              if (from.is_defined(row)) {
                array[place] = values[row];
                heap_bytes_ += heap_bytes_of_element(values[row]);
              } else {
                column.set_undefined(place);
              }
              ++place;
            });
          }
        });
      },
      column.content);
}

void ColumnBuffer::charge() {
  const std::size_t bytes = array_bytes_ + heap_bytes_ + ids_.capacity() * sizeof(TupleId) + size_ * more_bytes_;
  is_full_ = size_ > std::numeric_limits<std::uint32_t>::max() / 2 ||
             (bytes > account_.used() && !account_.take(bytes - account_.used()));
}

void ColumnBuffer::keep(std::span<const std::uint32_t> places) {
  heap_bytes_ = 0;
  for (Column& column : columns_)
    if (column.is_read) keep_in(column, places);
  if (!ids_.empty()) {
    for (std::size_t i = 0; i < places.size(); ++i) ids_[i] = id(places[i]);
    ids_.resize(places.size());
  }
  size_ = places.size();
  account_.clear();
  charge();
}

void ColumnBuffer::keep_in(Column& column, std::span<const std::uint32_t> places) {
  std::vector<std::uint8_t> undefined;
  if (!column.undefined.empty())
    for (const std::uint32_t place : places) undefined.push_back(column.is_defined(place) ? 0 : 1);
  column.undefined = std::move(undefined);
  std::visit(
      [&](auto& array) {
        for (std::size_t i = 0; i < places.size(); ++i) {
          if (places[i] != i) array[i] = std::move(array[places[i]]);
          heap_bytes_ += heap_bytes_of_element(array[i]);
        }
      },
      column.content);
}

void ColumnBuffer::clear() {
  columns_.clear();
  ids_ = {};
  size_ = array_bytes_ = heap_bytes_ = 0;
  is_full_ = false;
  account_.clear();
}

void ColumnBuffer::append_prefixes(std::size_t attribute, std::vector<std::uint64_t>& prefixes) const {
  const Column& column = columns_[attribute];
  std::visit(
      [&](const auto& array) {
        for (std::size_t place = 0; place < size_; ++place)
          prefixes.push_back(column.is_defined(place) ? prefix_of(array[place]) : 0);
      },
      column.content);
}

std::strong_ordering ColumnBuffer::compare(std::size_t attribute, std::uint32_t a, std::uint32_t b) const {
  const Column& column = columns_[attribute];
  if (!column.is_defined(a) || !column.is_defined(b)) return column.is_defined(a) <=> column.is_defined(b);
  return std::visit([&](const auto& array) { return compare_elements(array[a], array[b]); }, column.content);
}

TuplePtr ColumnBuffer::tuple(std::uint32_t place, std::size_t attribute_count) const {
  auto tuple = std::make_shared<Tuple>();
  tuple->attributes.reserve(attribute_count);
  for (std::size_t attribute = 0; attribute < attribute_count; ++attribute)
    tuple->attributes.push_back(value(attribute, place));
  tuple->id = id(place);
  return tuple;
}

void ColumnBuffer::gather(std::size_t attribute, std::span<const std::uint32_t> places, std::size_t size,
                          const SelectedRows& into, ValueColumn& to) const {
  const Column& column = columns_[attribute];
  if (!column.is_read) return;
  to.restart(size);
  std::visit(
      [&]<typename Element>(const Chunks<Element>& array) {
        Element* const target = array_of<Element>(to);
        for (std::size_t i = 0; i < places.size(); ++i) target[into[i]] = array[places[i]];
      },
      column.content);
  if (column.undefined.empty()) return;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!column.is_defined(places[i])) to.set_undefined(into[i]);
}

}  // namespace queries
