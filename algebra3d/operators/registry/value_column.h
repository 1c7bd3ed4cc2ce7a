#pragma once

#include <cassert>
#include <concepts>
#include <cstdint>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/value.h"

namespace algebra3d {

/// The C++ classes whose values stand in an array of their own in a column; all others stand there as Values.
template <typename T>
concept InColumn =
    std::same_as<T, std::int64_t> || std::same_as<T, double> || std::same_as<T, bool> || std::same_as<T, std::string>;

/// Rows of columns, by their positions: the first `count`, or those that `positions` lists.
struct SelectedRows {
  const std::uint32_t* positions = nullptr;  ///< null: all of the first `count`
  std::size_t count = 0;

  std::size_t operator[](std::size_t i) const { return positions == nullptr ? i : positions[i]; }
  template <typename Visit>
  void for_each(Visit visit) const {
    if (positions == nullptr)
      for (std::size_t row = 0; row < count; ++row) visit(row);
    else
      for (std::size_t i = 0; i < count; ++i) visit(std::size_t{positions[i]});
  }
};

/// Values of one type, a row each: an array of what the type's values are in C++, and which of them are undefined. It
/// is filled, read, and filled again; so its texts keep their memory.
class ValueColumn {
 public:
  explicit ValueColumn(const Type& type);

  const Type& type() const { return *type_; }
  /// The number of rows. A column without any stands for one that nobody reads: all its rows are undefined.
  std::size_t size() const { return undefined_.size(); }
  /// Makes `count` rows; all are defined, with values of before.
  void restart(std::size_t count);
  /// Adds rows up to `count`; the others stay as they are.
  void grow(std::size_t count);

  /// The array, if T is the class of the type.
  template <InColumn T>
  auto* data() {
    return std::get<Array<T>>(content_).data();
  }
  template <InColumn T>
  const auto* data() const {
    return std::get<Array<T>>(content_).data();
  }
  /// Calls `visit` with the array: of std::int64_t, double, std::uint8_t (a bool), std::string or Value.
  template <typename Visit>
  decltype(auto) visit(Visit visit) const {
    return std::visit([&](const auto& array) -> decltype(auto) { return visit(array.data()); }, content_);
  }
  template <InColumn T>
  bool holds() const {
    return std::holds_alternative<Array<T>>(content_);
  }
  /// The array of a type whose values stand as Values.
  Value* values() { return std::get<std::vector<Value>>(content_).data(); }

  bool has_undefined() const { return has_undefined_; }
  bool is_defined(std::size_t row) const { return row < size() && undefined_[row] == 0; }
  void set_undefined(std::size_t row) {
    undefined_[row] = 1;
    has_undefined_ = true;
  }

  Value value(std::size_t row) const;
  /// Sets the value of a row, which is defined so far.
  void set(std::size_t row, const Value& value);

 private:
  // A bool is a byte: std::vector<bool> has no array.
  template <typename T>
  using Array = std::vector<std::conditional_t<std::is_same_v<T, bool>, std::uint8_t, T>>;
  using Content = std::variant<Array<std::int64_t>, Array<double>, Array<bool>, Array<std::string>, std::vector<Value>>;
  static Content content_of(const Type& type);

  const Type* type_;
  Content content_;
  std::vector<std::uint8_t> undefined_;
  bool has_undefined_ = false;
};

}  // namespace algebra3d
