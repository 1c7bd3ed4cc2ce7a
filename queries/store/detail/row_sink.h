#pragma once

#include <vector>

#include "queries/store/detail/cell.h"

namespace queries {

/// Receives rows inside SQLite's loop over a table, which is faster than stepping for each row. It is called by the SQL
/// function `take_row(?, COLUMN...)`, whose parameter is bound to the sink: `SELECT 1 FROM t WHERE take_row(?, a, b)
/// ORDER BY id` returns a row as soon as the sink is full. Used by one thread.
class RowSink {
 public:
  /// SQLite's functions have at most 127 arguments; the sink is the first.
  static constexpr std::size_t kMaxColumns = 126;

  virtual ~RowSink() = default;
  RowSink() = default;
  RowSink(const RowSink&) = delete;
  RowSink& operator=(const RowSink&) = delete;

  /// Receives the columns of a row; their bytes are valid during the call. True: the sink is full.
  virtual bool take(std::span<Cell> row) = 0;

 private:
  friend class SqliteRowFunction;
  std::vector<Cell> row_;  // reused for all rows
};

}  // namespace queries
