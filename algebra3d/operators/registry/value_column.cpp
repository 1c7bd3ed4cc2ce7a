#include "algebra3d/operators/registry/value_column.h"

#include <algorithm>

namespace algebra3d {

ValueColumn::Content ValueColumn::content_of(const Type& type) {
  if (&type == &TypeOf<std::int64_t>::type()) return Array<std::int64_t>();
  if (&type == &TypeOf<double>::type()) return Array<double>();
  if (&type == &TypeOf<bool>::type()) return Array<bool>();
  if (&type == &TypeOf<std::string>::type()) return Array<std::string>();
  return std::vector<Value>();
}

ValueColumn::ValueColumn(const Type& type) : type_(&type), content_(content_of(type)) {}

void ValueColumn::restart(std::size_t count) {
  if (has_undefined_) std::ranges::fill(undefined_, std::uint8_t{0});
  has_undefined_ = false;
  undefined_.resize(count);
  grow(count);
}

void ValueColumn::grow(std::size_t count) {
  if (undefined_.size() < count) undefined_.resize(count);
  std::visit(
      [&]<typename Element>(std::vector<Element>& array) {
        if (array.size() >= count) return;  // what is not used keeps its memory
        if constexpr (std::is_same_v<Element, Value>)
          array.resize(count, Value(*type_));
        else
          array.resize(count);
      },
      content_);
}

Value ValueColumn::value(std::size_t row) const {
  if (!is_defined(row)) return Value(*type_);
  return std::visit(
      [&]<typename Element>(const std::vector<Element>& array) -> Value {
        if constexpr (std::is_same_v<Element, Value>)
          return array[row];
        else if constexpr (std::is_same_v<Element, std::uint8_t>)
          return Value::of<bool>(array[row] != 0);
        else
          return Value::of<Element>(array[row]);
      },
      content_);
}

void ValueColumn::set(std::size_t row, const Value& value) {
  assert(&value.type() == type_);
  if (!value.is_defined()) return set_undefined(row);
  std::visit(
      [&]<typename Element>(std::vector<Element>& array) {
        if constexpr (std::is_same_v<Element, Value>)
          array[row] = value;
        else if constexpr (std::is_same_v<Element, std::uint8_t>)
          array[row] = value.get<bool>() ? 1 : 0;
        else
          array[row] = value.get<Element>();
      },
      content_);
}

}  // namespace algebra3d
