#include "queries/store/detail/sqlite_connection.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "base/propagate.h"
#include "queries/store/detail/checked_vfs.h"
#include "queries/store/detail/page_sums.h"
#include "queries/store/detail/reading_step.h"
#include "queries/store/detail/sqlite_error.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::Result;
using algebra3d::Status;

/// Statements that are kept prepared; each relation needs about ten.
constexpr std::size_t kPreparedKept = 500;
/// Of SQLite's machine, between two looks at the wish to end: well below a millisecond.
constexpr int kStepsBetweenQuestions = 1000;
/// Between two attempts to get a lock: short enough that nobody notices it when a wait is to end.
constexpr std::chrono::milliseconds kLongestPause{25};

/// The name of the file as SQLite takes it: absolute, so that neither "file:x" nor ":memory:" means something else.
std::string name_for_sqlite(const std::filesystem::path& file, SqliteConnection::Access access) {
  std::string path = std::filesystem::absolute(file).string();
  if (access != SqliteConnection::Access::immutable) return path;
  std::string uri = "file:";
  for (const char c : path) {
    if (c == '?' || c == '#' || c == '%')
      uri += fmt::format("%{:02x}", static_cast<unsigned char>(c));
    else
      uri += c;
  }
  return uri + "?immutable=1";
}

int flags_of(SqliteConnection::Access access) {
  constexpr int kCommon = SQLITE_OPEN_FULLMUTEX | SQLITE_OPEN_EXRESCODE;
  switch (access) {
    case SqliteConnection::Access::create:
      return kCommon | SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
    case SqliteConnection::Access::read_write:
    case SqliteConnection::Access::recovering:
      return kCommon | SQLITE_OPEN_READWRITE;
    case SqliteConnection::Access::read_only:
      return kCommon | SQLITE_OPEN_READONLY;
    case SqliteConnection::Access::immutable:
      break;
  }
  return kCommon | SQLITE_OPEN_READONLY | SQLITE_OPEN_URI;
}

// Switches off everything that a damaged or hostile file could make SQLite do beyond reading tables.
void harden(sqlite3* handle) {
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
}

}  // namespace

Result<std::unique_ptr<SqliteConnection>> SqliteConnection::open(const std::filesystem::path& file, Access access,
                                                                 int busy_milliseconds) {
  sqlite3* handle = nullptr;
  const std::string name = name_for_sqlite(file, access);
  const int code = sqlite3_open_v2(name.c_str(), &handle, flags_of(access), checked_vfs());
  if (code != SQLITE_OK) {
    Error error = sqlite_error(handle, code, file.string(), "opening the database");
    sqlite3_close(handle);
    return error;
  }
  auto connection = std::unique_ptr<SqliteConnection>(new SqliteConnection(handle, file.string(), access));
  connection->announcement_.emplace(file);
  connection->longest_wait_ = std::chrono::milliseconds(busy_milliseconds);
  const auto wait = [](void* self, int attempt) {
    return static_cast<SqliteConnection*>(self)->wait_for_lock(attempt) ? 1 : 0;
  };
  sqlite3_busy_handler(handle, wait, connection.get());
  connection->end_when(nullptr);
  harden(handle);
  if (const int added = SqliteStatement::add_row_function(handle); added != SQLITE_OK)
    return connection->error(added, "opening the database");
  if (access == Access::recovering) A3D_TRY(connection->execute("PRAGMA query_only = ON"));
  return connection;
}

Result<std::unique_ptr<SqliteConnection>> SqliteConnection::open_temporary() {
  sqlite3* handle = nullptr;
  int code = sqlite3_open_v2("", &handle, flags_of(Access::create), nullptr);
  if (code == SQLITE_OK) code = SqliteStatement::add_row_function(handle);
  int reserved_bytes = kPageSumBytes;
  if (code == SQLITE_OK) code = sqlite3_file_control(handle, "main", SQLITE_FCNTL_RESERVE_BYTES, &reserved_bytes);
  if (code == SQLITE_OK)
    return std::unique_ptr<SqliteConnection>(new SqliteConnection(handle, "temporary file", Access::create));
  Error error = sqlite_error(handle, code, "temporary file", "making it");
  sqlite3_close(handle);
  return error;
}

SqliteConnection::~SqliteConnection() {
  for (const auto& [sql, prepared] : prepared_) sqlite3_finalize(prepared->statement);
  sqlite3_close_v2(handle_);
}

bool SqliteConnection::is_cancelled() const {
  const std::atomic<bool>* const cancel = cancel_;
  return cancel != nullptr && cancel->load(std::memory_order_relaxed);
}

// In place of sqlite3_busy_timeout, which does not hear the wish to end. False: no more waiting.
bool SqliteConnection::wait_for_lock(int attempt) {
  if (attempt == 0) wait_start_ = Clock::now();
  if (is_cancelled() || Clock::now() - wait_start_ >= longest_wait_) return false;
  std::this_thread::sleep_for(std::min(kLongestPause, std::chrono::milliseconds(1 << std::min(attempt, 10))));
  return true;
}

void SqliteConnection::end_when(const std::atomic<bool>* cancel) {
  const auto is_cancelled = [](void* flag) {
    const auto* const own = static_cast<const std::atomic<bool>*>(flag);
    return (own != nullptr && own->load(std::memory_order_relaxed)) || ReadingStep::is_interrupted() ? 1 : 0;
  };
  sqlite3_progress_handler(handle_, kStepsBetweenQuestions, is_cancelled,
                           const_cast<std::atomic<bool>*>(cancel));  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

bool SqliteConnection::has_moved() const {
  int moved = 0;
  return sqlite3_file_control(handle_, "main", SQLITE_FCNTL_HAS_MOVED, &moved) == SQLITE_OK && moved != 0;
}

bool SqliteConnection::proves_pages() const {
  return queries::proves_pages(handle_);
}

Error SqliteConnection::error(int code, std::string_view doing) const {
  const bool is_wait_ended = (code & 0xff) == SQLITE_BUSY && is_cancelled();
  return sqlite_error(handle_, is_wait_ended ? SQLITE_INTERRUPT : code, file_, doing);
}

Result<sqlite3_stmt*> SqliteConnection::prepare(std::string_view sql) {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v3(handle_, sql.data(), static_cast<int>(sql.size()), SQLITE_PREPARE_PERSISTENT,
                                      &statement, nullptr);
  if (code != SQLITE_OK) return error(code, "reading the tables of the database");
  return statement;
}

Status SqliteConnection::execute(std::string_view sql) {
  A3D_ASSIGN(sqlite3_stmt * prepared, prepare(sql));
  SqliteStatement statement(*this, prepared, nullptr);
  while (true) {
    A3D_ASSIGN(const bool has_row, statement.step());
    if (!has_row) return {};
  }
}

Status SqliteConnection::execute_again(std::string_view sql) {
  A3D_ASSIGN(SqliteStatement statement, use(sql));
  return statement.run();
}

Result<SqliteStatement> SqliteConnection::use(std::string_view sql) {
  const std::lock_guard lock(mutex_);
  const auto known = prepared_.find(std::string(sql));
  if (known != prepared_.end() && !known->second->in_use) {
    known->second->in_use = true;
    return SqliteStatement(*this, known->second->statement, &known->second->in_use);
  }
  A3D_ASSIGN(sqlite3_stmt * statement, prepare(sql));
  // Two uses of one text at the same time: the second one is not kept.
  if (known != prepared_.end()) return SqliteStatement(*this, statement, nullptr);
  if (prepared_.size() >= kPreparedKept) forget_unused();
  auto& added = prepared_[std::string(sql)];
  added = std::make_unique<Prepared>(Prepared{statement, true});
  return SqliteStatement(*this, statement, &added->in_use);
}

void SqliteConnection::forget_unused() {
  std::erase_if(prepared_, [](const auto& entry) {
    if (entry.second->in_use) return false;
    sqlite3_finalize(entry.second->statement);
    return true;
  });
}

void SqliteConnection::give_back(sqlite3_stmt* statement, bool* in_use) {
  if (in_use == nullptr) {
    sqlite3_finalize(statement);
    return;
  }
  sqlite3_reset(statement);
  sqlite3_clear_bindings(statement);
  const std::lock_guard lock(mutex_);
  *in_use = false;
}

Result<std::int64_t> SqliteConnection::integer(std::string_view sql) {
  A3D_ASSIGN(SqliteStatement statement, use(sql));
  A3D_ASSIGN(const bool has_row, statement.step());
  if (!has_row || !statement.column(0).is(Cell::Kind::integer))
    return Error{algebra3d::ErrorCode::database_corrupt, R"({}: expected a number for "{}")", file_, sql};
  return statement.column(0).integer;
}

// With a schema that may be written, SQLite no longer compares the number of pages with the header's, nor parses all of
// the schema or none; the pages that are there it reads as ever.
void SqliteConnection::tolerate_damaged_pages() {
  tolerate_page_faults(handle_);
  sqlite3_db_config(handle_, SQLITE_DBCONFIG_DEFENSIVE, 0, nullptr);
  sqlite3_db_config(handle_, SQLITE_DBCONFIG_WRITABLE_SCHEMA, 1, nullptr);
}

Result<std::string> SqliteConnection::image() {
  sqlite3_int64 size = 0;
  const std::unique_ptr<unsigned char, decltype(&sqlite3_free)> bytes(sqlite3_serialize(handle_, "main", &size, 0),
                                                                      &sqlite3_free);
  if (bytes == nullptr) return error(SQLITE_NOMEM, "copying the database");
  const std::span<std::byte> pages = std::as_writable_bytes(std::span(bytes.get(), static_cast<std::size_t>(size)));
  const std::size_t page_bytes = pages.size() < kFileHeaderBytes ? 0 : page_format(pages).page_bytes;
  for (std::size_t page = 0; page_bytes > 0 && (page + 1) * page_bytes <= pages.size(); ++page)
    set_page_sum(pages.subspan(page * page_bytes, page_bytes), static_cast<std::uint32_t>(page + 1));
  return std::string(bytes.get(), bytes.get() + size);
}

void SqliteConnection::forget_pages() {
  forget_page_faults(handle_);
  sqlite3_db_release_memory(handle_);
}

std::set<PageFault> SqliteConnection::page_faults() const {
  return queries::page_faults(handle_);
}

}  // namespace queries
