#include "queries/store/detail/sqlite_statement.h"

#include <exception>
#include <new>
#include <utility>

#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "queries/store/detail/reading_step.h"
#include "queries/store/detail/sqlite_connection.h"

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

/// The content of a protected value of SQLite. Bytes of texts are taken as blobs: as they are stored.
Cell cell_of(sqlite3_value* value) {
  const auto bytes = [&] {
    const void* const start = sqlite3_value_blob(value);
    const auto size = static_cast<std::size_t>(sqlite3_value_bytes(value));
    return start == nullptr ? std::string_view() : std::string_view(static_cast<const char*>(start), size);
  };
  switch (sqlite3_value_type(value)) {
    case SQLITE_INTEGER:
      return Cell::of(static_cast<std::int64_t>(sqlite3_value_int64(value)));
    case SQLITE_FLOAT:
      return Cell::of(sqlite3_value_double(value));
    case SQLITE_TEXT:
      return Cell::text(bytes());
    case SQLITE_BLOB:
      return Cell::blob(bytes());
    default:
      return {};
  }
}

/// Distinguishes a bound taker from other pointers.
constexpr const char* kTakerType = "queries::RowSink";

/// For messages. To SQLite the end of a transaction is not a change.
std::string_view doing(sqlite3_stmt* statement) {
  const std::string_view text = sqlite3_sql(statement);
  if (text == "COMMIT" || text.starts_with("RELEASE")) return "writing";
  return sqlite3_stmt_readonly(statement) != 0 ? "reading" : "writing";
}

}  // namespace

/// The function as SQLite calls it: no exception may pass through its frames.
class SqliteRowFunction {
 public:
  /// The exception caught on this thread; null if there is none.
  static std::exception_ptr& caught() {
    thread_local std::exception_ptr exception;
    return exception;
  }
  static void call(sqlite3_context* context, int count, sqlite3_value** values) {
    auto* const taker = static_cast<RowSink*>(sqlite3_value_pointer(values[0], kTakerType));
    if (taker == nullptr) return sqlite3_result_error(context, "take_row: expected a taker", -1);
    try {
      taker->row_.resize(static_cast<std::size_t>(count - 1));
      for (int i = 1; i < count; ++i) taker->row_[static_cast<std::size_t>(i - 1)] = cell_of(values[i]);
      sqlite3_result_int(context, taker->take(taker->row_) ? 1 : 0);
    } catch (const algebra3d::Interrupted&) {
      sqlite3_result_error_code(context, SQLITE_INTERRUPT);
    } catch (const std::bad_alloc&) {
      caught() = std::current_exception();  // for the step that has called SQLite
      sqlite3_result_error_nomem(context);
    }
  }
};

int SqliteStatement::add_row_function(sqlite3* handle) {
  return sqlite3_create_function_v2(handle, "take_row", -1, SQLITE_UTF8 | SQLITE_DIRECTONLY, nullptr,
                                    SqliteRowFunction::call, nullptr, nullptr, nullptr);
}

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

SqliteStatement& SqliteStatement::bind(int parameter, RowSink& taker) {
  const int code = sqlite3_bind_pointer(statement_, parameter, &taker, kTakerType, nullptr);
  if (bind_code_ == SQLITE_OK) bind_code_ = code;
  return *this;
}

algebra3d::Result<bool> SqliteStatement::step() {
  const ReadingStep reading(sqlite3_stmt_readonly(statement_) != 0);
  const int code = bind_code_ == SQLITE_OK ? sqlite3_step(statement_) : bind_code_;
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  if (SqliteRowFunction::caught()) std::rethrow_exception(std::exchange(SqliteRowFunction::caught(), nullptr));
  return connection_->error(code, doing(statement_));
}

algebra3d::Status SqliteStatement::run() {
  A3D_ASSIGN(const bool has_row, step());
  assert(!has_row);
  static_cast<void>(has_row);
  return {};
}

Cell SqliteStatement::column(int index) const {
  sqlite3_mutex* const mutex = sqlite3_db_mutex(sqlite3_db_handle(statement_));
  sqlite3_mutex_enter(mutex);
  const Cell cell = cell_of(sqlite3_column_value(statement_, index));
  sqlite3_mutex_leave(mutex);
  return cell;
}

// One lock for all of them: each value is protected by it, and the functions that ask a statement would lock for each.
void SqliteStatement::read_columns(std::span<Cell> columns) const {
  sqlite3_mutex* const mutex = sqlite3_db_mutex(sqlite3_db_handle(statement_));
  sqlite3_mutex_enter(mutex);
  for (std::size_t i = 0; i < columns.size(); ++i)
    columns[i] = cell_of(sqlite3_column_value(statement_, static_cast<int>(i)));
  sqlite3_mutex_leave(mutex);
}

}  // namespace queries
