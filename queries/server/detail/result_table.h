#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "algebra3d/values/display/shape.h"
#include "base/context.h"
#include "base/work_memory.h"
#include "queries/streams/relation.h"

namespace queries {

/// The levels of detail of the cells that were asked for last. Used by one thread.
class LevelCache {
 public:
  struct Entry {
    std::size_t row = 0;
    std::size_t column = 0;
    std::vector<algebra3d::DrawnShape> levels;  ///< from the finest to the coarsest
  };

  /// The levels of a cell; null if they are not there.
  const Entry* find(std::size_t row, std::size_t column) const {
    for (const Entry& entry : entries_)
      if (entry.row == row && entry.column == column) return &entry;
    return nullptr;
  }
  /// Keeps the levels of a cell and returns them; beyond `kMostBytes` the oldest others go.
  const Entry& keep(Entry entry) {
    entries_.push_back(std::move(entry));
    while (entries_.size() > 1 && bytes() > kMostBytes) entries_.pop_front();
    return entries_.back();
  }

 private:
  static constexpr std::size_t kMostBytes = std::size_t{32} << 20U;

  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const Entry& entry : entries_)
      for (const algebra3d::DrawnShape& shape : entry.levels) sum += content_bytes(shape);
    return sum;
  }

  std::deque<Entry> entries_;
};

/// Limits of a copy of a result.
struct CopyLimits {
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::size_t bytes = kNone;           ///< of all values, as estimated
  std::size_t value_elements = kNone;  ///< of one value that lies in the database
};

/// The result of a statement as a table whose rows are numbered from 0: a relation, or a value as one row with the
/// column `value`. Rows are read on demand and in any order; forward reading is cheapest. Used by one thread, while the
/// statement that made the relation runs.
class ResultTable {
 public:
  ResultTable(std::shared_ptr<Relation> relation, std::size_t count) : relation_(std::move(relation)), count_(count) {}
  static Result<ResultTable> of(std::shared_ptr<Relation> relation);
  static ResultTable of_value(const Value& value);

  const TypeExpr& tuple_type() const { return relation_->tuple_type(); }
  std::size_t count() const { return count_; }
  /// The tuple of a row, which must exist. Errors: those of the store.
  Result<TuplePtr> row(std::size_t index);
  /// A copy whose values are loaded, which outlives the statement. It takes `memory`, which must outlive it, and for
  /// the rest a temporary file. `between` is called after each row; it may read this table. Errors: limit_exceeded
  /// beyond the limits, in time that does not depend on the size of a value; those of the store, of temporary files and
  /// of `between`; interrupted.
  Result<ResultTable> loaded_copy(const algebra3d::Context& context, algebra3d::WorkMemory& memory,
                                  const CopyLimits& limits, const std::function<Status()>& between);
  /// The size of the rows of a loaded copy, about; else 0.
  std::size_t copied_bytes() const { return copied_bytes_; }
  /// Data made of its cells, kept for later requests.
  LevelCache& levels() { return levels_; }

 private:
  Result<TuplePtr> next_row();

  std::shared_ptr<Relation> relation_;
  std::size_t count_ = 0;
  std::size_t copied_bytes_ = 0;
  TupleStreamPtr scan_;
  std::size_t next_ = 0;      // row that scan_ gives next
  std::vector<TupleId> ids_;  // of the rows that were read, in a stored relation
  LevelCache levels_;
};

}  // namespace queries
