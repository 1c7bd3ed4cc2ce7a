#pragma once

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

/// Tuples of a stream without batches, put into columns.
class BatchOfTuples {
 public:
  /// `read`: by attribute; the others are left out.
  BatchOfTuples(const TypeExpr& tuple, const std::vector<bool>& read);
  /// The next tuples, `most` at most; null at the end. Valid until the next call.
  Result<const Batch*> next(TupleStream& tuples, std::size_t most);

 private:
  std::vector<bool> read_;
  std::vector<ValueColumn> columns_;
  std::vector<TupleId> ids_;
  Batch batch_;
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
