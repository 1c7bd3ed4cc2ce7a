#pragma once

#include <vector>

#include "queries/store/cell.h"

namespace queries {

/// Takes rows while SQLite goes through a table, without leaving SQLite for each of them. A statement calls it where
/// its text has the SQL function `take_row(?, COLUMN...)` with the taker bound to the parameter; so `SELECT 1 FROM t
/// WHERE take_row(?, a, b) ORDER BY id` has a row once the taker has enough. Used by one thread.
class RowTaker {
 public:
  /// SQLite's functions have 127 arguments, the taker is the first.
  static constexpr std::size_t kMaxColumns = 126;

  virtual ~RowTaker() = default;
  RowTaker() = default;
  RowTaker(const RowTaker&) = delete;
  RowTaker& operator=(const RowTaker&) = delete;

  /// The columns of a row; their bytes are valid during the call. True: enough.
  virtual bool take(std::span<Cell> row) = 0;

 private:
  friend class SqliteRowFunction;
  std::vector<Cell> row_;  // kept, so that no row needs a new one
};

}  // namespace queries
