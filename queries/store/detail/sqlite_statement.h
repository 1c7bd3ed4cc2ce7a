#pragma once

#include <cstdint>
#include <string_view>

#include <sqlite3.h>

#include "algebra3d/base/error.h"
#include "queries/store/detail/cell.h"
#include "queries/store/detail/row_sink.h"

namespace queries {

class SqliteConnection;

/// A prepared statement in use; it returns to its connection at the end of the scope. Bound texts and blobs must live
/// until then; those that are read are valid until the next step. Used by one thread; different statements of a
/// connection may be used by different threads.
class SqliteStatement {
 public:
  /// Registers the SQL function `take_row` of RowSink. Returns SQLite's result code.
  static int add_row_function(sqlite3* handle);

  /// Takes a statement that SqliteConnection::use has prepared. At the end `in_use` is set to false; if null, the
  /// statement is finalised.
  SqliteStatement(SqliteConnection& connection, sqlite3_stmt* statement, bool* in_use);
  ~SqliteStatement();
  SqliteStatement(SqliteStatement&& other) noexcept;
  SqliteStatement& operator=(SqliteStatement&&) = delete;
  SqliteStatement(const SqliteStatement&) = delete;
  SqliteStatement& operator=(const SqliteStatement&) = delete;

  /// Binds a parameter, counted from 1.
  SqliteStatement& bind(int parameter, const Cell& cell);
  SqliteStatement& bind(int parameter, std::int64_t value) { return bind(parameter, Cell::of(value)); }
  SqliteStatement& bind(int parameter, std::string_view text) { return bind(parameter, Cell::text(text)); }
  /// Binds the first argument of the SQL function `take_row`; the sink must live until the end of this object.
  SqliteStatement& bind(int parameter, RowSink& taker);

  /// Steps to the next row; false at the end. Also returns the errors of `bind`.
  algebra3d::Result<bool> step();
  /// Runs a statement without rows.
  algebra3d::Status run();

  /// A column of the row, counted from 0.
  Cell column(int index) const;
  /// Reads the first columns of the row.
  void read_columns(std::span<Cell> columns) const;

 private:
  SqliteConnection* connection_;
  sqlite3_stmt* statement_;
  bool* in_use_;
  int bind_code_ = SQLITE_OK;
};

}  // namespace queries
