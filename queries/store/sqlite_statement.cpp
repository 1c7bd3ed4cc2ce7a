#include "queries/store/sqlite_statement.h"

#include <utility>

#include "queries/store/sqlite_connection.h"

namespace queries {
namespace {

int bind_cell(sqlite3_stmt* statement, int parameter, const Cell& cell) {
  // SQLite takes a null pointer for NULL, but an empty text or blob is not NULL.
  const char* const bytes = cell.bytes.data() != nullptr ? cell.bytes.data() : "";
  switch (cell.kind) {
    case Cell::Kind::integer:
      return sqlite3_bind_int64(statement, parameter, cell.integer);
    case Cell::Kind::real:
      return sqlite3_bind_double(statement, parameter, cell.real);
    case Cell::Kind::text:
      return sqlite3_bind_text64(statement, parameter, bytes, cell.bytes.size(), SQLITE_STATIC, SQLITE_UTF8);
    case Cell::Kind::blob:
      return sqlite3_bind_blob64(statement, parameter, bytes, cell.bytes.size(), SQLITE_STATIC);
    case Cell::Kind::null:
      break;
  }
  return sqlite3_bind_null(statement, parameter);
}

/// For messages. To SQLite the end of a transaction is not a change.
std::string_view doing(sqlite3_stmt* statement) {
  const std::string_view text = sqlite3_sql(statement);
  if (text == "COMMIT" || text.starts_with("RELEASE")) return "writing";
  return sqlite3_stmt_readonly(statement) != 0 ? "reading" : "writing";
}

}  // namespace

SqliteStatement::SqliteStatement(SqliteConnection& connection, sqlite3_stmt* statement, bool* in_use)
    : connection_(&connection), statement_(statement), in_use_(in_use) {}

SqliteStatement::SqliteStatement(SqliteStatement&& other) noexcept
    : connection_(other.connection_),
      statement_(std::exchange(other.statement_, nullptr)),
      in_use_(std::exchange(other.in_use_, nullptr)),
      bind_code_(other.bind_code_) {}

SqliteStatement::~SqliteStatement() {
  if (statement_ != nullptr) connection_->give_back(statement_, in_use_);
}

SqliteStatement& SqliteStatement::bind(int parameter, const Cell& cell) {
  const int code = bind_cell(statement_, parameter, cell);
  if (bind_code_ == SQLITE_OK) bind_code_ = code;
  return *this;
}

algebra3d::Result<bool> SqliteStatement::step() {
  const int code = bind_code_ == SQLITE_OK ? sqlite3_step(statement_) : bind_code_;
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  return connection_->error(code, doing(statement_));
}

algebra3d::Status SqliteStatement::run() {
  ASSIGN_OR_RETURN(const bool has_row, step());
  assert(!has_row);
  static_cast<void>(has_row);
  return {};
}

Cell SqliteStatement::column(int index) const {
  const auto bytes = [&](const void* start) {
    const int size = sqlite3_column_bytes(statement_, index);
    return start == nullptr ? std::string_view()
                            : std::string_view(static_cast<const char*>(start), static_cast<std::size_t>(size));
  };
  switch (sqlite3_column_type(statement_, index)) {
    case SQLITE_INTEGER:
      return Cell::of(static_cast<std::int64_t>(sqlite3_column_int64(statement_, index)));
    case SQLITE_FLOAT:
      return Cell::of(sqlite3_column_double(statement_, index));
    case SQLITE_TEXT:
      return Cell::text(bytes(sqlite3_column_text(statement_, index)));
    case SQLITE_BLOB:
      return Cell::blob(bytes(sqlite3_column_blob(statement_, index)));
    default:
      return {};
  }
}

}  // namespace queries
