#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/database/value.h"

namespace algebra3d::database {

namespace detail {
class Engine;
class Handover;
}  // namespace detail

/// A column of a result: its name and the type of its values in the query language.
struct Column {
  std::string name;
  std::string type;

  friend auto operator<=>(const Column&, const Column&) = default;
};

/// A row of a result. Immutable and cheap to copy. May outlive the database.
class Row {
 public:
  Row(std::shared_ptr<const std::vector<Column>> columns, std::vector<Value> values);
  // A moved-from row keeps its values: moving copies, which costs as much as counting.
  Row(const Row&) = default;
  Row& operator=(const Row&) = default;
  ~Row() = default;

  std::size_t size() const { return values_->size(); }
  const std::vector<Column>& columns() const { return *columns_; }
  const std::vector<Value>& values() const { return *values_; }
  /// The value of a column, by an index from 0, which must exist, or by name; an unknown name yields an undefined value
  /// with that reason.
  const Value& operator[](std::size_t index) const { return (*values_)[index]; }
  Value operator[](std::string_view name) const;

  /// The notation of the values, between brackets.
  std::string text() const;

  /// Compares the values in order; column names are ignored.
  friend bool operator==(const Row& a, const Row& b) { return *a.values_ == *b.values_; }
  friend std::strong_ordering operator<=>(const Row& a, const Row& b) { return *a.values_ <=> *b.values_; }
  std::size_t hash() const;

 private:
  std::shared_ptr<const std::vector<Column>> columns_;
  std::shared_ptr<const std::vector<Value>> values_;
};

std::ostream& operator<<(std::ostream& out, const Row& row);

/// The rows of one statement, computed on demand, a few in advance, on a thread of the database. The statement ends,
/// and keeps its changes, when the end behind the last row is asked for: when `next` returns nothing, `all` or
/// `for_each` returns, or a range-based for ends by itself. Until then the database runs no other statement, and a
/// statement that changes something keeps other writers waiting. Destroying or closing it earlier cancels the statement
/// like `Database::cancel` and always undoes its changes, even if all rows were taken. (A statement without a result,
/// such as `let`, has ended when `Database::query` returns.) Used by one thread at a time.
class Rows {
 public:
  ~Rows();
  Rows(Rows&& other) noexcept;
  Rows& operator=(Rows&& other) noexcept;

  /// The columns; empty for a statement without a result, such as `let`.
  const std::vector<Column>& columns() const { return *columns_; }
  /// The next row, or nothing at the end. Errors: those of the statement. Further calls return the same end or error.
  Result<std::optional<Row>> next();
  /// Calls `visit` with each remaining row, on this thread. If it throws, the next call continues with the next row.
  Status for_each(const std::function<void(const Row&)>& visit);
  /// All remaining rows.
  Result<std::vector<Row>> all();

  /// An input iterator over the remaining rows. An error of the statement is the last element:
  ///
  ///     for (const Result<Row>& row : rows) {
  ///       if (!row) return row.error();
  ///       std::cout << *row;
  ///     }
  class Iterator {
   public:
    using value_type = Result<Row>;
    using difference_type = std::ptrdiff_t;

    const Result<Row>& operator*() const { return *row_; }
    const Result<Row>* operator->() const { return &*row_; }
    Iterator& operator++();
    void operator++(int) { ++*this; }
    friend bool operator==(const Iterator& a, std::default_sentinel_t) { return !a.row_; }

   private:
    friend class Rows;
    explicit Iterator(Rows& rows) : rows_(&rows) { take(); }
    void take();

    Rows* rows_;
    std::optional<Result<Row>> row_;  // nothing: the end
  };
  /// Takes the first remaining row. The rows must outlive the iterator.
  Iterator begin() { return Iterator(*this); }
  static std::default_sentinel_t end() { return {}; }

  /// Ends the statement, as the destructor does; there are no more rows.
  void close();

 private:
  friend class Database;
  Rows(std::shared_ptr<detail::Engine> engine, std::shared_ptr<detail::Handover> handover);
  Status wait_for_columns();
  Status fetch();
  Status finish();

  std::shared_ptr<detail::Engine> engine_;      // null once the statement has ended
  std::shared_ptr<detail::Handover> handover_;  // the same
  std::shared_ptr<const std::vector<Column>> columns_;
  std::vector<Row> rows_;  // a batch; rows from next_ on have not been returned yet
  std::size_t next_ = 0;
  Status outcome_;
};

}  // namespace algebra3d::database

template <>
struct std::hash<algebra3d::database::Row> {
  std::size_t operator()(const algebra3d::database::Row& row) const { return row.hash(); }
};
