#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "algebra3d/operators/registry/value_column.h"
#include "queries/streams/datum.h"

namespace queries {

using algebra3d::SelectedRows;
using algebra3d::ValueColumn;

/// How many tuples stand in a batch, at most if nothing asks for more.
inline constexpr std::size_t kBatchTuples = 1024;

/// Some tuples of a stream in columns. The columns may have more rows than tuples: a filter selects rows, and moves
/// nothing.
struct Batch {
  std::size_t size = 0;                     ///< rows of the columns that are read
  std::vector<const ValueColumn*> columns;  ///< by attribute; without rows, if nobody reads it
  const TupleId* ids = nullptr;             ///< by row; null: the tuples have none
  SelectedRows rows;                        ///< of the tuples, in the order of the stream
};

/// The type of a term, if its values stand in columns as what they are in C++ (algebra3d::InColumn); else null.
const algebra3d::Type* type_in_columns(const TypeExpr& type);

/// The tuple of a row.
TuplePtr tuple_of(const Batch& batch, std::size_t row);

/// The array of a column by the class of its elements: std::int64_t, double, std::uint8_t (a bool), std::string or
/// Value.
template <typename Element>
Element* array_of(ValueColumn& column) {
  if constexpr (std::is_same_v<Element, Value>)
    return column.values();
  else if constexpr (std::is_same_v<Element, std::uint8_t>)
    return column.data<bool>();
  else
    return column.data<Element>();
}

/// Makes as many rows of `to` as are selected of `from`, with their values; without rows if that has none.
void gather(const ValueColumn& from, const SelectedRows& rows, ValueColumn& to);

/// A batch with columns of its own, which are filled, read, and filled again.
struct OwnBatch {
  std::vector<ValueColumn> columns;
  std::vector<TupleId> ids;
  Batch batch;

  /// Makes a column of each type, unless there are columns.
  void set_types(const std::vector<const algebra3d::Type*>& types);
  /// Makes the batch of the first `count` rows, which have been filled.
  void finish(std::size_t count);
};

/// The tuples of a stream in batches: those of the stream or, if it has none, its tuples put into columns.
class BatchReader {
 public:
  explicit BatchReader(TupleStream& tuples) : tuples_(tuples) {}
  /// `read`: by attribute; the others are left out of the columns that are made of tuples.
  BatchReader(TupleStream& tuples, std::vector<bool> read) : tuples_(tuples), read_(std::move(read)) {}
  /// The next tuples, `most` at most; null at the end. Valid until the next call.
  Result<const Batch*> next(std::size_t most);

 private:
  bool is_read(std::size_t attribute) const { return read_.empty() || read_[attribute]; }

  TupleStream& tuples_;
  std::vector<bool> read_;
  OwnBatch own_;
};

/// A function of a tuple, for many tuples at once: with the results and the notes that it has for each by itself.
class ColumnFunction {
 public:
  virtual ~ColumnFunction() = default;
  ColumnFunction() = default;
  ColumnFunction(const ColumnFunction&) = delete;
  ColumnFunction& operator=(const ColumnFunction&) = delete;
  /// The results for these rows of a batch, valid until the next call, and as long as the batch.
  virtual Result<const ValueColumn*> evaluate(const Batch& batch, SelectedRows rows) = 0;
};
using ColumnFunctionPtr = std::shared_ptr<ColumnFunction>;

}  // namespace queries
