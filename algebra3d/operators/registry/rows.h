#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/values/types/value.h"
#include "base/context.h"
#include "base/propagate.h"

namespace algebra3d {

/// A named, typed column of a table operator.
struct Column {
  std::string name;
  const Type* type = nullptr;
};

/// One value per column.
using Row = std::vector<Value>;

/// The result of a table operator: rows that the host pulls one by one. Used by one thread; ends with the first
/// nothing.
class RowSource {
 public:
  virtual ~RowSource() = default;
  RowSource() = default;
  RowSource(const RowSource&) = delete;
  RowSource& operator=(const RowSource&) = delete;
  /// The next row, or nothing at the end. `context`: that of the call that made this source.
  virtual Result<std::optional<Row>> next(Context& context) = 0;
  /// The number of all rows, if it is known before they are made.
  virtual std::optional<std::uint64_t> count() const { return std::nullopt; }
};
using RowSourcePtr = std::unique_ptr<RowSource>;

namespace detail {

// The type and the value of a cell; an empty optional is undefined.
template <typename T>
struct CellOf {
  static const Type& type() { return TypeOf<T>::type(); }
  static Value value(T content) { return Value::of<T>(std::move(content)); }
};

template <typename T>
struct CellOf<std::optional<T>> {
  static const Type& type() { return TypeOf<T>::type(); }
  static Value value(std::optional<T> content) { return content ? Value::of<T>(*std::move(content)) : Value(type()); }
};

}  // namespace detail

/// The result of the C++ function of a table operator (`table<...>` in overload.h): rows of cells of these types, made
/// on demand. A cell of type std::optional may be undefined. The function object must own the data of the rows, since
/// the arguments of the call do not live as long.
template <typename... T>
class Rows {
 public:
  using Cells = std::tuple<T...>;
  using Next = std::function<Result<std::optional<Cells>>(Context&)>;

  explicit Rows(Next next) : next_(std::move(next)) {}
  /// So many rows.
  Rows(std::uint64_t count, Next next) : next_(std::move(next)), count_(count) {}
  /// Rows that exist already.
  explicit Rows(std::vector<Cells> rows)
      : next_([rows = std::move(rows), position = std::size_t{0}](Context&) mutable {
          using Returned = Result<std::optional<Cells>>;
          return position == rows.size() ? Returned(std::nullopt) : Returned(std::move(rows[position++]));
        }) {}

  static std::vector<const Type*> types() { return {&detail::CellOf<T>::type()...}; }
  RowSourcePtr source() && { return std::make_unique<Source>(std::move(next_), count_); }

 private:
  class Source final : public RowSource {
   public:
    Source(Next next, std::optional<std::uint64_t> count) : next_(std::move(next)), count_(count) {}
    std::optional<std::uint64_t> count() const override { return count_; }
    Result<std::optional<Row>> next(Context& context) override {
      A3D_ASSIGN(std::optional<Cells> cells, next_(context));
      if (!cells) return std::optional<Row>();
      return std::optional(std::apply(
          [](T&... cell) {
            Row row;
            row.reserve(sizeof...(T));
            (row.push_back(detail::CellOf<T>::value(std::move(cell))), ...);
            return row;
          },
          *cells));
    }

   private:
    Next next_;
    std::optional<std::uint64_t> count_;
  };

  Next next_;
  std::optional<std::uint64_t> count_;
};

/// The rows of a table of one column, which a host with streams of plain values returns as such a stream.
template <typename T>
class Elements : public Rows<T> {
 public:
  using Rows<T>::Rows;
};

}  // namespace algebra3d
