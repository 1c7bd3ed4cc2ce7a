#include "queries/store/database_file.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include <unistd.h>

#include "queries/store/tables.h"

namespace queries {
namespace {

namespace fs = std::filesystem;
using Access = SqliteConnection::Access;

// Where SQLite's header has what, in big-endian order: https://www.sqlite.org/fileformat.html, section 1.3.
constexpr std::string_view kSqliteMagic = "SQLite format 3";
constexpr std::size_t kHeaderBytes = 100;
constexpr std::size_t kUserVersionOffset = 60;
constexpr std::size_t kApplicationIdOffset = 68;

Error foreign(const fs::path& file, std::string_view found) {
  return {ErrorCode::database_foreign, "{}: expected an algebra3d database, found {}", file.string(), found};
}

Error unusable(const fs::path& file, int reason) {
  return {reason == EACCES || reason == EPERM ? ErrorCode::file_missing : ErrorCode::io_error,
          "{}: cannot open the database: {}", file.string(), std::generic_category().message(reason)};
}

std::uint32_t big_endian(const std::array<char, kHeaderBytes>& header, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(header[offset + i]);
  return value;
}

bool may_create(OpenMode mode) {
  return mode == OpenMode::create || mode == OpenMode::open_or_create;
}

Status check_version(const fs::path& file, std::int64_t version) {
  if (version <= kDatabaseVersion) return {};
  return Error{ErrorCode::database_version,
               "{}: the database has version {}, this program reads versions up to {}; use a newer algebra3d",
               file.string(), version, kDatabaseVersion};
}

// The bytes are looked at before SQLite sees them: opening another program's database could already change it, by
// rolling back what that program left behind.
Status check_header(const fs::path& file) {
  std::array<char, kHeaderBytes> header{};
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return unusable(file, errno);
  stream.read(header.data(), header.size());
  const auto size = static_cast<std::size_t>(stream.gcount());
  if (size == 0) return foreign(file, "an empty file");
  if (std::memcmp(header.data(), kSqliteMagic.data(), kSqliteMagic.size() + 1) != 0)
    return foreign(file, "a file of another kind");
  if (size < kHeaderBytes)
    return Error{ErrorCode::database_corrupt, "{}: the file ends after {} bytes, within the header of a database",
                 file.string(), size};
  const std::uint32_t application = big_endian(header, kApplicationIdOffset);
  if (application != kApplicationId)
    return foreign(file, application == 0 ? "a SQLite database of another program"
                                          : fmt::format("a SQLite database of application {:#x}", application));
  return check_version(file, big_endian(header, kUserVersionOffset));
}

Status check_missing(const fs::path& file, OpenMode mode) {
  const fs::path folder = fs::absolute(file).parent_path();
  std::error_code error;
  if (!fs::is_directory(folder, error))
    return Error{may_create(mode) ? ErrorCode::file_missing : ErrorCode::database_missing,
                 "{}: there is no folder '{}'", file.string(), folder.string()};
  if (!may_create(mode)) return Error{ErrorCode::database_missing, "{}: there is no such file", file.string()};
  return {};
}

/// What is to be done with the file.
enum class Found : std::uint8_t { nothing, empty, database };

Result<Found> inspect(const fs::path& file, OpenMode mode) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) {
    RETURN_IF_ERROR(check_missing(file, mode));
    return Found::nothing;
  }
  if (error) return unusable(file, error.value());
  if (status.type() == fs::file_type::directory) return foreign(file, "a folder");
  if (status.type() != fs::file_type::regular) return foreign(file, "something that is no file");
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) return unusable(file, error.value());
  if (size == 0 && may_create(mode)) return Found::empty;
  if (mode == OpenMode::create) return Error{ErrorCode::database_exists, "{}: the file exists already", file.string()};
  RETURN_IF_ERROR(check_header(file));
  return Found::database;
}

// A process that was killed may have left work for the next one that opens the file, and SQLite does it only on a
// connection that may write. Without the right to make lock files next to it, a database can still be read if nobody is
// writing: then all of it lies in the one file.
Access read_access(const fs::path& file) {
  const fs::path folder = fs::absolute(file).parent_path();
  if (::access(folder.c_str(), W_OK) == 0 && ::access(file.c_str(), W_OK) == 0) return Access::recovering;
  std::error_code error;
  const auto log_bytes = fs::file_size(file.string() + "-wal", error);
  const bool has_log = !error && log_bytes > 0;
  return ::access(folder.c_str(), W_OK) != 0 && !has_log ? Access::immutable : Access::read_only;
}

Status make_tables(SqliteConnection& connection) {
  RETURN_IF_ERROR(connection.execute("BEGIN EXCLUSIVE"));
  // Another process may have been faster.
  ASSIGN_OR_RETURN(const std::int64_t application, connection.integer("PRAGMA application_id"));
  if (application != kApplicationId) {
    RETURN_IF_ERROR(connection.execute(fmt::format("PRAGMA application_id = {}", kApplicationId)));
    RETURN_IF_ERROR(connection.execute(fmt::format("PRAGMA user_version = {}", kDatabaseVersion)));
    for (const char* table : kCreateTables) RETURN_IF_ERROR(connection.execute(table));
  }
  return connection.execute("COMMIT");
}

Status use_write_ahead_log(SqliteConnection& connection) {
  ASSIGN_OR_RETURN(SqliteStatement statement, connection.use("PRAGMA journal_mode = WAL"));
  ASSIGN_OR_RETURN(const bool has_row, statement.step());
  if (has_row && statement.column(0).bytes == "wal") return {};
  return Error{ErrorCode::io_error, "{}: the file system does not allow a write-ahead log", connection.file()};
}

Status configure(SqliteConnection& connection, const StoreOptions& options) {
  RETURN_IF_ERROR(connection.execute("PRAGMA cell_size_check = ON"));
  RETURN_IF_ERROR(connection.execute(fmt::format("PRAGMA cache_size = -{}", options.page_cache_kilobytes)));
  ASSIGN_OR_RETURN(const std::int64_t application, connection.integer("PRAGMA application_id"));
  if (application != kApplicationId) return foreign(connection.file(), "a SQLite database of another program");
  ASSIGN_OR_RETURN(const std::int64_t version, connection.integer("PRAGMA user_version"));
  RETURN_IF_ERROR(check_version(connection.file(), version));
  if (options.max_pages > 0)
    RETURN_IF_ERROR(connection.execute(fmt::format("PRAGMA max_page_count = {}", options.max_pages)));
  return {};
}

// FULL: a committed statement survives the loss of power, not only the end of the process.
Status prepare_for_writing(SqliteConnection& connection) {
  RETURN_IF_ERROR(connection.execute("PRAGMA synchronous = FULL"));
  return use_write_ahead_log(connection);
}

Status move_into_place(const fs::path& made, const fs::path& file, Found found) {
  // A link does not replace a database that another process has made meanwhile; that one is then used.
  const bool is_empty_file = found == Found::empty;
  const int code = is_empty_file ? ::rename(made.c_str(), file.c_str()) : ::link(made.c_str(), file.c_str());
  const int problem = code == 0 ? 0 : errno;
  std::error_code ignored;
  fs::remove(made, ignored);
  if (problem == 0 || problem == EEXIST) return {};
  return unusable(file, problem);
}

// A database appears under its name only when it is complete, so that a process which is killed meanwhile leaves no
// half of one. The tables are made with a rollback journal, so that the header is in the file itself and not in a log.
Status create_file(const fs::path& file, Found found, const StoreOptions& options) {
  const fs::path draft = file.string() + ".new-" + std::to_string(::getpid());
  Status status;
  {
    auto connection = SqliteConnection::open(draft, Access::create, options.busy_milliseconds);
    if (!connection) return std::move(connection).error();
    status = (*connection)->execute("PRAGMA synchronous = FULL");
    if (status) status = make_tables(**connection);
  }
  if (status) return move_into_place(draft, file, found);
  std::error_code ignored;
  fs::remove(draft, ignored);
  return status;
}

}  // namespace

Result<std::unique_ptr<SqliteConnection>> open_database_file(const fs::path& file, OpenMode mode,
                                                             const StoreOptions& options) {
  ASSIGN_OR_RETURN(const Found found, inspect(file, mode));
  const bool writes = mode != OpenMode::read_only;
  if (found != Found::database) RETURN_IF_ERROR(create_file(file, found, options));
  const Access access = writes ? Access::read_write : read_access(file);
  ASSIGN_OR_RETURN(auto connection, SqliteConnection::open(file, access, options.busy_milliseconds));
  if (writes && connection->is_read_only())
    return Error{ErrorCode::database_read_only, "{}: the file cannot be written; open it with --read-only",
                 file.string()};
  if (writes) RETURN_IF_ERROR(prepare_for_writing(*connection));
  RETURN_IF_ERROR(configure(*connection, options));
  return connection;
}

}  // namespace queries
