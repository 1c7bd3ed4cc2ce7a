#include "queries/store/detail/database_file.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <sys/stat.h>
#include <unistd.h>

#include "algebra3d/base/error.h"
#include "base/file_error.h"
#include "base/open_databases.h"
#include "base/propagate.h"
#include "queries/store/database_creation.h"
#include "queries/store/database_draft.h"
#include "queries/store/detail/page_sums.h"
#include "queries/store/detail/tables.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Status;

namespace {

namespace fs = std::filesystem;

/// A journal that names another file ends with these bytes; another one has page content, or zeros, there.
/// Source: https://www.sqlite.org/fileformat.html, section 3, and `readSuperJournal` of SQLite.
constexpr std::string_view kMagic("\xd9\xd5\x05\xf9\x20\xa1\x63\xd7", 8);

bool names_another_file(const fs::path& journal) {
  std::ifstream stream(journal, std::ios::binary | std::ios::ate);
  if (!stream || stream.tellg() < static_cast<std::streamoff>(2 * kMagic.size())) return false;
  stream.seekg(-static_cast<std::streamoff>(kMagic.size()), std::ios::end);
  std::string end(kMagic.size(), '\0');
  stream.read(end.data(), static_cast<std::streamsize>(end.size()));
  return stream && end == kMagic;
}

/// Checks SQLite's files beside a database before SQLite sees them, since they may have come with a database of
/// somebody else: each must be a regular file, and a rollback journal must not name another file. SQLite takes that for
/// the journal of several databases and deletes it when it has rolled back, wherever it lies; this program makes no
/// such journals. Errors: database_foreign with the name of the file beside.
// SQLite names them after the file that a symbolic link leads to.
Status check_sidecar_files(const fs::path& database) {
  std::error_code error;
  const fs::path file = fs::canonical(database, error);
  if (error) return {};  // reported where the database is opened
  for (const std::string ending : algebra3d::kSidecarEndings) {
    const fs::path beside = file.string() + ending;
    const fs::file_status status = fs::symlink_status(beside, error);
    if (status.type() == fs::file_type::not_found) continue;
    if (status.type() != fs::file_type::regular)
      return Error{ErrorCode::database_foreign,
                   "not a regular file, as SQLite's files beside a database are; remove it"}
          .about(beside.string());
    if (ending == "-journal" && names_another_file(beside))
      return Error{ErrorCode::database_foreign,
                   "the journal names another file, which would be deleted; algebra3d makes no such journals; "
                   "remove it, and look at the database with `check database`"}
          .about(beside.string());
  }
  return {};
}

using Access = SqliteConnection::Access;

// Where SQLite's header has what, in big-endian order: https://www.sqlite.org/fileformat.html, section 1.3.
constexpr std::string_view kSqliteMagic = "SQLite format 3";
constexpr std::size_t kHeaderBytes = 100;
constexpr std::size_t kUserVersionOffset = 60;
constexpr std::size_t kApplicationIdOffset = 68;

Error foreign(const fs::path& file, std::string_view found) {
  return Error{ErrorCode::database_foreign, "expected an algebra3d database, found {}", found}.about(file.string());
}

// It was there a moment ago.
Error unusable(const fs::path& file, int reason) {
  if (reason == ENOENT) return deleted_meanwhile(file);
  return {reason == EACCES || reason == EPERM ? ErrorCode::file_missing : ErrorCode::io_error,
          "{}: cannot open the database: {}", file.string(),
          reason == EACCES ? "there is no permission to read it" : algebra3d::write_obstacle(file, reason)};
}

std::uint32_t big_endian(const std::array<char, kHeaderBytes>& header, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(header[offset + i]);
  return value;
}

// One whose maker was killed just when it was complete has the mark of a draft until somebody writes to it.
bool is_ours(std::int64_t application) {
  return application == kApplicationId || application == kDraftApplicationId;
}

bool may_create(OpenMode mode) {
  return mode == OpenMode::create || mode == OpenMode::open_or_create;
}

Status check_version(const fs::path& file, std::int64_t version) {
  if (version <= kDatabaseVersion) return {};
  return Error{ErrorCode::database_version,
               "the database has version {}, this program reads versions up to {}; use a newer algebra3d", version,
               kDatabaseVersion}
      .about(file.string());
}

// The bytes are looked at before SQLite sees them: opening another program's database could already change it, by
// rolling back what that program left behind.
// One that this process has open is not opened here: closing it would give up SQLite's locks.
Status check_header(const fs::path& file) {
  if (algebra3d::open_database_with(file)) return {};
  std::array<char, kHeaderBytes> header{};
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return unusable(file, errno);
  stream.read(header.data(), header.size());
  const auto size = static_cast<std::size_t>(stream.gcount());
  if (size == 0) return foreign(file, "an empty file");
  if (std::memcmp(header.data(), kSqliteMagic.data(), kSqliteMagic.size() + 1) != 0)
    return Error{ErrorCode::database_foreign, "not a SQLite file; expected an algebra3d database"}.about(file.string());
  if (size < kHeaderBytes)
    return Error{ErrorCode::database_corrupt, "the file ends after {} bytes, within the header of a database", size}
        .about(file.string());
  const std::uint32_t application = big_endian(header, kApplicationIdOffset);
  if (!is_ours(application))
    return foreign(file, application == 0 ? "a SQLite database of another program"
                                          : fmt::format("a SQLite database of application {:#x}", application));
  const std::uint32_t version = big_endian(header, kUserVersionOffset);
  A3D_TRY(check_version(file, version));
  if (page_format(std::as_bytes(std::span(header))).is_consistent()) return {};
  return Error{ErrorCode::database_corrupt,
               "the header says that the database has version {}, but its pages have {} checksums, unlike those of "
               "that version; the header was changed",
               version, version < kFirstVersionWithPageSums ? "room for" : "no room for"}
      .about(file.string());
}

Status check_missing(const fs::path& file, OpenMode mode) {
  const fs::path folder = fs::absolute(file).parent_path();
  std::error_code error;
  if (!fs::is_directory(folder, error))
    return Error{may_create(mode) ? ErrorCode::file_missing : ErrorCode::database_missing,
                 algebra3d::write_obstacle(fs::absolute(file), ENOENT)}
        .about(file.string());
  if (!may_create(mode)) return Error{ErrorCode::database_missing, "there is no such file"}.about(file.string());
  return {};
}

/// The content of the file.
enum class Found : std::uint8_t { nothing, empty, database };

Result<Found> inspect(const fs::path& file, OpenMode mode) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (may_create(mode) && !fs::exists(status)) A3D_TRY(check_name_length(file));
  if (status.type() == fs::file_type::not_found) {
    A3D_TRY(check_missing(file, mode));
    return Found::nothing;
  }
  if (error) return unusable(file, error.value());
  if (status.type() == fs::file_type::directory) return foreign(file, "a folder");
  if (status.type() != fs::file_type::regular) return foreign(file, "something that is not a regular file");
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) return unusable(file, error.value());
  if (size == 0 && may_create(mode)) return Found::empty;
  if (mode == OpenMode::create)
    return Error{ErrorCode::database_exists, "the file exists already"}.about(file.string());
  A3D_TRY(check_header(file));
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

Status use_write_ahead_log(SqliteConnection& connection) {
  A3D_ASSIGN(SqliteStatement statement, connection.use("PRAGMA journal_mode = WAL"));
  A3D_ASSIGN(const bool has_row, statement.step());
  if (has_row && statement.column(0).bytes == "wal") return {};
  return Error{ErrorCode::io_error, "the file system does not allow a write-ahead log"}.about(connection.file());
}

Status configure(SqliteConnection& connection, const StoreOptions& options) {
  A3D_TRY(connection.execute("PRAGMA cell_size_check = ON"));
  A3D_TRY(connection.execute(fmt::format("PRAGMA cache_size = -{}", options.page_cache_kilobytes)));
  A3D_ASSIGN(const std::int64_t application, connection.integer("PRAGMA application_id"));
  if (!is_ours(application)) return foreign(connection.file(), "a SQLite database of another program");
  A3D_ASSIGN(const std::int64_t version, connection.integer("PRAGMA user_version"));
  A3D_TRY(check_version(connection.file(), version));
  if (options.max_pages > 0) A3D_TRY(connection.execute(fmt::format("PRAGMA max_page_count = {}", options.max_pages)));
  return {};
}

// FULL: a committed statement survives the loss of power, not only the end of the process. A log that has grown while
// readers held it becomes short again.
Status prepare_for_writing(SqliteConnection& connection) {
  constexpr int kLogBytes = 1 << 26;
  A3D_TRY(connection.execute(fmt::format("PRAGMA journal_size_limit = {}", kLogBytes)));
  A3D_TRY(connection.execute("PRAGMA synchronous = FULL"));
  return use_write_ahead_log(connection);
}

// SQLite keeps its log beside the file, so that the folder must take files too.
Status check_writable(const fs::path& file) {
  const fs::path target = fs::absolute(file);
  const int reason = ::access(file.c_str(), W_OK) != 0 ? errno : algebra3d::folder_obstacle(target);
  if (reason == 0) return {};
  return Error{ErrorCode::database_read_only, "the database cannot be written: {}; open it with --read-only",
               algebra3d::write_obstacle(target, reason)}
      .about(file.string());
}

bool may_write(OpenMode mode) {
  return mode != OpenMode::read_only && mode != OpenMode::read_damaged;
}

/// Device and inode; none: there is no such file.
std::optional<std::pair<dev_t, ino_t>> identity_of(const fs::path& file) {
  struct stat facts {};
  if (::stat(file.c_str(), &facts) != 0) return std::nullopt;
  return std::pair(facts.st_dev, facts.st_ino);
}

// SQLite names the log after the file: under each name there would be another one, and statements in one would not be
// seen through the other, neither by a writer nor by a reader. Nothing shows where the other names are.
Status check_names(const fs::path& file) {
  struct stat facts {};
  if (::stat(file.c_str(), &facts) != 0 || facts.st_nlink <= 1) return {};
  return Error{ErrorCode::io_error,
               "the file has {} names (hard links), and each would get a log of its own, so that statements would "
               "be lost; remove the other names, or copy the file and use the copy; a symbolic link does no harm",
               facts.st_nlink}
      .about(file.string());
}

Result<std::unique_ptr<SqliteConnection>> connect(const fs::path& file, OpenMode mode, const StoreOptions& options) {
  const bool writes = may_write(mode);
  if (writes) A3D_TRY(check_writable(file));
  if (writes && mode != OpenMode::draft) A3D_TRY(finish_database(file, options.busy_milliseconds));
  A3D_TRY(check_names(file));
  A3D_TRY(check_sidecar_files(file));
  const Access access = writes ? Access::read_write : read_access(file);
  A3D_ASSIGN(auto connection, SqliteConnection::open(file, access, options.busy_milliseconds));
  if (mode == OpenMode::read_damaged) connection->tolerate_damaged_pages();
  if (writes && connection->is_read_only())
    return Error{ErrorCode::database_read_only, "the file cannot be written; open it with --read-only"}.about(
        file.string());
  if (writes) A3D_TRY(prepare_for_writing(*connection));
  A3D_TRY(configure(*connection, options));
  return connection;
}

}  // namespace

// A log may still hold what a file lacks, so that this is not an error by itself.
std::string lost_bytes(const fs::path& file) {
  constexpr std::size_t kPageSizeOffset = 16;
  constexpr std::size_t kPageCountOffset = 28;
  std::array<char, kHeaderBytes> header{};
  std::error_code unknown;
  const std::uintmax_t found = fs::file_size(file, unknown);
  if (unknown || algebra3d::open_database_with(file)) return {};
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(header.data(), header.size())) return {};
  const std::uint32_t page_bytes = big_endian(header, kPageSizeOffset) >> 16;
  const std::uintmax_t expected =
      std::uintmax_t{page_bytes == 1 ? 65536 : page_bytes} * big_endian(header, kPageCountOffset);
  if (found >= expected) return {};
  return fmt::format("the file ends after {} of the {} bytes that its header states", found, expected);
}

Status check_database_header(const fs::path& file) {
  return check_header(file);
}

Error deleted_meanwhile(const fs::path& file) {
  return Error{ErrorCode::database_missing, "another process has deleted the database while it was being opened"}.about(
      file.string());
}

Result<std::unique_ptr<SqliteConnection>> open_database_file(const fs::path& file, OpenMode mode,
                                                             const StoreOptions& options) {
  A3D_TRY(algebra3d::check_file_name(file));
  if (may_write(mode)) remove_database_leftovers(file);
  A3D_ASSIGN(const Found found, inspect(file, mode));
  if (found != Found::database) A3D_TRY(create_database_file(file, found == Found::empty));
  const auto before = identity_of(file);
  if (!before) return deleted_meanwhile(file);
  auto connection = connect(file, mode, options);
  // All failures on a file that somebody deletes have this one reason, whatever they look like.
  if (!connection && identity_of(file) != before) return deleted_meanwhile(file);
  return connection;
}

}  // namespace queries
