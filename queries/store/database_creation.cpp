// Database files are made and deleted.
#include "queries/store/database_creation.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "base/file_error.h"
#include "base/open_databases.h"
#include "base/propagate.h"
#include "queries/store/database_draft.h"
#include "queries/store/detail/database_file.h"

namespace queries {
namespace {

namespace fs = std::filesystem;

Error deleted_already(const fs::path& file) {
  return Error{ErrorCode::database_missing, "another process has deleted the database already"}.about(file.string());
}

Status open_in_other_process(const fs::path& file, std::string_view verb) {
  return Error{ErrorCode::database_open, "another process has the database open; {} it when that process has closed it",
               verb}
      .about(file.string());
}

Status open_in_other_session(const fs::path& file, std::string_view verb) {
  return Error{ErrorCode::database_open,
               "another session of this program has the database open; {} it when that has closed it", verb}
      .about(file.string());
}

/// Takes SQLite's locks of the file; false if a process holds one. In a database with a log each process that has it
/// open holds one all the time.
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
Status create_database_file(const fs::path& file, bool replaces_empty) {
  A3D_ASSIGN(DatabaseDraft draft, DatabaseDraft::create(file, kNewEnding));
  Status status = draft.publish(replaces_empty);
  if (status || status.error().code == ErrorCode::database_exists) return {};
  return status;
}

bool makes_database(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) return true;
  return status.type() == fs::file_type::regular && fs::file_size(file, error) == 0 && !error;
}

// A file that cannot be opened here is reported where the database is opened.
Status check_not_open_elsewhere(const fs::path& name, std::string_view verb) {
  std::error_code error;
  const fs::path file = fs::canonical(name, error);
  if (error) return {};
  if (algebra3d::open_database_with(file)) return open_in_other_session(file, verb);
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);  // NOLINT(*-vararg)
  if (descriptor < 0) return {};
  const bool is_free = lock_out_others(descriptor);
  ::close(descriptor);
  return is_free ? Status() : open_in_other_process(file, verb);
}

// No change through SQLite: a full disk, or damage, must not keep a database from being deleted. A process that waits
// for the lock to open the database finds that the file has moved.
Status delete_database_file(const fs::path& name) {
  std::error_code error;
  if (!fs::exists(name, error)) return Error{ErrorCode::database_missing, "there is no such file"}.about(name.string());
  const fs::path file = fs::canonical(name, error);
  if (error == std::errc::no_such_file_or_directory) return deleted_already(name);
  if (error) return algebra3d::write_error(name, error.value());
  if (algebra3d::open_database_with(file)) return open_in_other_session(file, "delete");
  const Status header = check_database_header(file);
  if (!header && header.error().code == ErrorCode::database_missing) return deleted_already(name);
  A3D_TRY(header);
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);  // NOLINT(*-vararg)
  if (descriptor < 0) return errno == ENOENT ? deleted_already(name) : algebra3d::write_error(file, errno);
  Status status = lock_out_others(descriptor) ? Status() : open_in_other_process(file, "delete");
  for (const char* ending : {"-wal", "-shm", "-journal", ""}) {
    const std::string doomed = file.string() + ending;
    if (status && ::unlink(doomed.c_str()) != 0 && errno != ENOENT) status = algebra3d::write_error(doomed, errno);
  }
  ::close(descriptor);
  if (status && fs::is_symlink(name, error)) fs::remove(name, error);
  return status;
}

}  // namespace queries
