// Files of databases come and go.
#include "queries/store/database_creation.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "algebra3d/base/file_error.h"
#include "algebra3d/base/open_databases.h"
#include "queries/store/database_file.h"
#include "queries/store/tables.h"

namespace queries {
namespace {

namespace fs = std::filesystem;
using algebra3d::DraftFile;
using Access = SqliteConnection::Access;

constexpr std::string_view kNewMark = ".new-";
constexpr std::string_view kDraftMagic("SQLite format 3\0", 16);
/// Room in a name for the longest ending of an interim one: `.restore-PID-N.new-PID-N-journal`.
constexpr std::size_t kLongestEnding = 60;

Status make_tables(SqliteConnection& connection) {
  RETURN_IF_ERROR(connection.execute("BEGIN EXCLUSIVE"));
  RETURN_IF_ERROR(connection.execute(fmt::format("PRAGMA application_id = {}", kApplicationId)));
  RETURN_IF_ERROR(connection.execute(fmt::format("PRAGMA user_version = {}", kDatabaseVersion)));
  for (const char* table : kCreateTables) RETURN_IF_ERROR(connection.execute(table));
  return connection.execute("COMMIT");
}

// The tables are made with a rollback journal, so that the header is in the file itself and not in a log.
Status fill(const fs::path& draft, const StoreOptions& options) {
  ASSIGN_OR_RETURN(const auto connection, SqliteConnection::open(draft, Access::create, options.busy_milliseconds));
  RETURN_IF_ERROR(connection->execute("PRAGMA synchronous = FULL"));
  return make_tables(*connection);
}

// A link does not replace a database that another process has made meanwhile; that one is then used.
Status move_into_place(DraftFile& draft, const fs::path& file, bool replaces_empty) {
  const char* const made = draft.path().c_str();
  const int code = replaces_empty ? ::rename(made, file.c_str()) : ::link(made, file.c_str());
  const int problem = code == 0 ? 0 : errno;
  draft.remove();
  if (problem == 0 || problem == EEXIST) return {};
  return algebra3d::write_error(file, problem);
}

Status check_name_length(const fs::path& file) {
  struct statvfs facts {};
  if (::statvfs(algebra3d::folder_of(file).c_str(), &facts) != 0) return {};
  const std::size_t most = facts.f_namemax - kLongestEnding;
  const std::size_t length = file.filename().string().size();
  if (length <= most) return {};
  return Error{
      ErrorCode::io_error,
      "{}: the name of the file has {} bytes; a database's may have {}, since files with longer names are kept "
      "beside it",
      file.string(), length, most};
}

/// `X.db.new-1-0` and `X.db.restore-1.new-2-0`: a name, then marks with numbers.
bool is_leftover(std::string_view name) {
  bool has_mark = false;
  while (true) {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string_view::npos || dot == 0) return has_mark;
    const std::string_view last = name.substr(dot);
    const bool is_mark =
        (last.starts_with(kNewMark) && algebra3d::is_draft_number(last.substr(kNewMark.size()))) ||
        (last.starts_with(kRestoreMark) && algebra3d::is_draft_number(last.substr(kRestoreMark.size())));
    if (!is_mark) return has_mark;
    has_mark = true;
    name = name.substr(0, dot);
  }
}

bool begins_as_ours(const fs::path& file) {
  return !algebra3d::open_database_with(file) && check_database_header(file).ok();
}

Status open_elsewhere(const fs::path& file) {
  return Error{ErrorCode::database_open,
               "{}: another process has the database open; delete it when that process has closed it", file.string()};
}

/// Whether this descriptor's file is free of SQLite's locks, which are then held by it: in a database with a log, each
/// process that has it open holds one all the time.
bool lock_out_others(int descriptor) {
  struct flock range {};
  range.l_type = F_WRLCK;
  range.l_whence = SEEK_SET;
  range.l_start = 0x40000000;  // https://www.sqlite.org/fileformat.html, section 1.2
  range.l_len = 512;
  return ::fcntl(descriptor, F_OFD_SETLK, &range) == 0;  // NOLINT(*-vararg)
}

}  // namespace

// A database appears under its name only when it is complete, so that a process which is killed meanwhile leaves no
// half of one.
Result<DraftFile> create_database_file(const fs::path& file, bool replaces_empty, const StoreOptions& options) {
  RETURN_IF_ERROR(check_name_length(file));
  ASSIGN_OR_RETURN(DraftFile draft, DraftFile::create(file, file.filename().string() + std::string(kNewMark), ""));
  Status status = fill(draft.path(), options);
  if (status) status = move_into_place(draft, file, replaces_empty);
  if (status) return draft;
  draft.remove();
  return std::move(status).error();
}

// An empty file is a leftover only of the database at hand: others may have empty files with such names.
void remove_database_leftovers(const fs::path& file) {
  const std::string own = file.filename().string() + ".";
  std::error_code error;
  for (fs::directory_iterator entry(algebra3d::folder_of(file), error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!is_leftover(name)) continue;
    if (name.starts_with(own) || begins_as_ours(entry->path()))
      algebra3d::remove_if_abandoned(entry->path(), kDraftMagic);
  }
}

// No change through SQLite: a full disk, or damage, must not keep a database from being deleted. A process that waits
// for the lock to open the database finds that the file has moved.
Status delete_database_file(const fs::path& name) {
  std::error_code error;
  if (!fs::exists(name, error)) return Error{ErrorCode::database_missing, "{}: there is no such file", name.string()};
  const fs::path file = fs::canonical(name, error);
  if (error) return algebra3d::write_error(name, error.value());
  if (algebra3d::open_database_with(file)) return open_elsewhere(file);
  RETURN_IF_ERROR(check_database_header(file));
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);  // NOLINT(*-vararg)
  if (descriptor < 0) return algebra3d::write_error(file, errno);
  Status status = lock_out_others(descriptor) ? Status() : open_elsewhere(file);
  for (const char* ending : {"-wal", "-shm", "-journal", ""}) {
    const std::string doomed = file.string() + ending;
    if (status && ::unlink(doomed.c_str()) != 0 && errno != ENOENT) status = algebra3d::write_error(doomed, errno);
  }
  ::close(descriptor);
  if (status && fs::is_symlink(name, error)) fs::remove(name, error);
  return status;
}

}  // namespace queries
