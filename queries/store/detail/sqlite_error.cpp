#include "queries/store/detail/sqlite_error.h"

#include <cerrno>
#include <optional>
#include <string>

#include "queries/store/detail/checked_vfs.h"
#include "queries/store/sqlite_memory.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;

// A quota and a limit on the size of files are to the user what a full disk is; SQLite itself knows only ENOSPC. At the
// end of a transaction it does not keep the system's reason, which still stands in errno: nothing that went well since
// has changed it.
ErrorCode io_error_code(sqlite3* connection, int code) {
  const int last_reason = errno;
  if (code == SQLITE_IOERR_NOMEM) return ErrorCode::out_of_memory;
  const int kept_reason = connection != nullptr ? sqlite3_system_errno(connection) : 0;
  const int reason = kept_reason != 0 ? kept_reason : last_reason;
  const bool is_write = code == SQLITE_IOERR_WRITE || code == SQLITE_IOERR_TRUNCATE || code == SQLITE_IOERR_SHMSIZE;
  if (is_write && (reason == ENOSPC || reason == EDQUOT || reason == EFBIG)) return ErrorCode::disk_full;
  return ErrorCode::io_error;
}

ErrorCode error_code(sqlite3* connection, int code) {
  switch (code & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_PROTOCOL:
      return ErrorCode::database_busy;
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_AUTH:
      return ErrorCode::database_read_only;
    case SQLITE_FULL:
      return ErrorCode::disk_full;
    case SQLITE_IOERR:
      return io_error_code(connection, code);
    case SQLITE_CANTOPEN:
      return ErrorCode::io_error;
    case SQLITE_NOMEM:
      return ErrorCode::out_of_memory;
    case SQLITE_TOOBIG:
      return ErrorCode::limit_exceeded;
    case SQLITE_INTERRUPT:
      return ErrorCode::interrupted;
    // Our statements are right, so that SQLite refuses one only if a table or column is not there, or holds what was
    // never written: the file is damaged.
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
    case SQLITE_ERROR:
    case SQLITE_CONSTRAINT:
    case SQLITE_MISMATCH:
    case SQLITE_SCHEMA:
      return ErrorCode::database_corrupt;
    default:
      return ErrorCode::internal;
  }
}

/// Whether SQLite says no more than that the file is damaged.
bool says_only_damage(sqlite3* connection, int code) {
  return std::string_view(sqlite3_errmsg(connection)) == sqlite3_errstr(code & 0xff);
}

std::string message_of(sqlite3* connection, int code) {
  if ((code & 0xff) == SQLITE_CORRUPT && (connection == nullptr || says_only_damage(connection, code)))
    return "the file is damaged";
  if (connection == nullptr) return sqlite3_errstr(code);
  sqlite3_mutex* const mutex = sqlite3_db_mutex(connection);
  sqlite3_mutex_enter(mutex);
  std::string text = sqlite3_errcode(connection) == (code & 0xff) || sqlite3_extended_errcode(connection) == code
                         ? sqlite3_errmsg(connection)
                         : sqlite3_errstr(code);
  sqlite3_mutex_leave(mutex);
  return ascii_text(text);
}

}  // namespace

std::string ascii_text(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c < ' ' || c > '~') c = '?';
  return result;
}

std::string page_fault_text(const PageFault& fault) {
  return fmt::format("page {}{} is not what algebra3d has written: its checksum is wrong", fault.page,
                     fault.is_in_log ? " in the log (-wal)" : "");
}

Error page_fault_error(std::string_view file, const PageFault& fault) {
  return Error{ErrorCode::database_corrupt, "{}{}", page_fault_text(fault), kPageFaultRemedy}.about(file);
}

Error sqlite_error(sqlite3* connection, int code, std::string_view file, std::string_view doing) {
  if (code == SQLITE_BUSY_SNAPSHOT)
    return Error{ErrorCode::database_busy,
                 "{}: another process changed the database while this statement was reading it; run it again", doing}
        .about(file);
  const bool is_damage = (code & 0xff) == SQLITE_CORRUPT;
  if (const auto fault = is_damage && connection != nullptr ? take_page_fault(connection) : std::nullopt)
    return page_fault_error(file, *fault);
  const ErrorCode kind = error_code(connection, code);
  if (kind == ErrorCode::database_busy)
    return Error{kind, "{}: another process is writing to the database; try again when it has finished", doing}.about(
        file);
  if (kind == ErrorCode::out_of_memory && take_sqlite_refusal())
    return Error{ErrorCode::limit_exceeded,
                 "{}: a stored value needs more than the memory limit leaves (`set \"memory\"` or --memory); raise it",
                 doing}
        .about(file);
  if (kind == ErrorCode::disk_full) return Error{kind, "{}: the disk is full", doing}.about(file);
  if (kind == ErrorCode::database_read_only)
    return Error{kind,
                 "{}: the file, its folder or a file of SQLite beside it cannot be written; check the permissions, "
                 "or open it with --read-only",
                 doing}
        .about(file);
  if ((code & 0xff) == SQLITE_CANTOPEN)
    return Error{kind,
                 "{}: the file, or one of SQLite beside it (-wal, -shm, -journal), cannot be opened or created; check "
                 "the permissions of the file and its folder",
                 doing}
        .about(file);
  return Error{kind, "{}: {}", doing, message_of(connection, code)}.about(file);
}

}  // namespace queries
