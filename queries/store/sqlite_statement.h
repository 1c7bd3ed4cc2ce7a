#pragma once

#include <cstdint>
#include <string_view>

#include <sqlite3.h>

#include "algebra3d/base/error.h"
#include "queries/store/cell.h"
#include "queries/store/row_taker.h"

namespace queries {

class SqliteConnection;

/// A prepared statement in use: bound, stepped, read; given back to its connection when this goes out of scope.
/// Texts and blobs that are bound must live until then; those that are read live until the next step.
/// Used by one thread; several statements of one connection may be used by several.
class SqliteStatement {
 public:
  /// Gives a connection the SQL function `take_row` of RowTaker; SQLite's result code.
  static int add_row_function(sqlite3* handle);

  /// A statement that SqliteConnection::use has prepared. `in_use` is set to false at the end; null: it is finalised.
  SqliteStatement(SqliteConnection& connection, sqlite3_stmt* statement, bool* in_use);
  ~SqliteStatement();
  SqliteStatement(SqliteStatement&& other) noexcept;
  SqliteStatement& operator=(SqliteStatement&&) = delete;
  SqliteStatement(const SqliteStatement&) = delete;
  SqliteStatement& operator=(const SqliteStatement&) = delete;

  /// Parameters count from 1.
  SqliteStatement& bind(int parameter, const Cell& cell);
  SqliteStatement& bind(int parameter, std::int64_t value) { return bind(parameter, Cell::of(value)); }
  SqliteStatement& bind(int parameter, std::string_view text) { return bind(parameter, Cell::text(text)); }
  /// The first argument of the SQL function `take_row`; lives until the statement is given back.
  SqliteStatement& bind(int parameter, RowTaker& taker);

  /// True if there is a row. Errors of `bind` come out here.
  algebra3d::Result<bool> step();
  /// Runs a statement that has no rows.
  algebra3d::Status run();

  /// Columns count from 0.
  Cell column(int index) const;
  /// The first columns of the row.
  void read_columns(std::span<Cell> columns) const;

 private:
  SqliteConnection* connection_;
  sqlite3_stmt* statement_;
  bool* in_use_;
  int bind_code_ = SQLITE_OK;
};

}  // namespace queries
