// Databases that are being made, and their remains when their maker is killed.
#include "queries/store/database_draft.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstring>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "base/file_error.h"
#include "base/open_databases.h"
#include "base/propagate.h"
#include "queries/store/detail/sqlite_connection.h"
#include "queries/store/detail/tables.h"

namespace queries {
namespace {

namespace fs = std::filesystem;
using algebra3d::DraftFile;
using algebra3d::write_error;

/// Where SQLite's header has the application_id, in big-endian order: https://www.sqlite.org/fileformat.html, 1.3.
constexpr off_t kApplicationIdPlace = 68;
/// Room in a name for the longest ending of an interim one: `.restore-PID-N-journal`.
constexpr std::size_t kLongestEnding = 60;
/// A rollback journal of SQLite begins so, and is not longer before the first page is changed.
constexpr std::string_view kJournalMagic("\xd9\xd5\x05\xf9\x20\xa1\x63\xd7", 8);
constexpr std::uintmax_t kEmptyJournalBytes = 512;

std::array<char, 4> mark_bytes(std::int64_t number) {
  std::array<char, 4> bytes{};
  for (char& byte : bytes) {
    byte = static_cast<char>(number >> 24 & 0xff);
    number <<= 8;
  }
  return bytes;
}

std::string first_bytes(int descriptor, std::size_t count) {
  std::string bytes(count, '\0');
  const ssize_t size = ::pread(descriptor, bytes.data(), bytes.size(), 0);
  bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return bytes;
}

bool has_draft_mark(int descriptor) {
  constexpr std::string_view kFileMagic("SQLite format 3\0", 16);
  const auto mark = mark_bytes(kDraftApplicationId);
  const std::string header = first_bytes(descriptor, kApplicationIdPlace + mark.size());
  return header.size() == kApplicationIdPlace + mark.size() && header.starts_with(kFileMagic) &&
         std::memcmp(header.data() + kApplicationIdPlace, mark.data(), mark.size()) == 0;
}

Status take_mark_away(const fs::path& file, int descriptor) {
  const auto mark = mark_bytes(kApplicationId);
  const auto size = static_cast<ssize_t>(mark.size());
  errno = 0;
  if (::pwrite(descriptor, mark.data(), mark.size(), kApplicationIdPlace) != size || ::fsync(descriptor) != 0)
    return write_error(file, errno);
  return {};
}

/// The bytes of a database without objects that is marked as a draft. Made in memory and written at once: so the mark
/// is there from the first byte on, and SQLite needs no journal.
Result<std::string> draft_bytes() {
  A3D_ASSIGN(const auto connection, SqliteConnection::open_temporary());
  A3D_TRY(connection->execute("BEGIN"));
  A3D_TRY(connection->execute(fmt::format("PRAGMA application_id = {}", kDraftApplicationId)));
  A3D_TRY(connection->execute(fmt::format("PRAGMA user_version = {}", kDatabaseVersion)));
  for (const char* table : kCreateTables) A3D_TRY(connection->execute(table));
  A3D_TRY(connection->execute("COMMIT"));
  return connection->image();
}

Status write_all(const fs::path& file, int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return write_error(file, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::fsync(descriptor) == 0 ? Status() : write_error(file, errno);
}

// Two names for a moment where the file system knows no better: a process that is killed then leaves the interim one,
// with the mark, and the next one removes it.
int give_name(const fs::path& made, const fs::path& file, bool replaces_empty) {
  if (replaces_empty) return ::rename(made.c_str(), file.c_str()) == 0 ? 0 : errno;
  if (::renameat2(AT_FDCWD, made.c_str(), AT_FDCWD, file.c_str(), RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP) return errno;
  return ::link(made.c_str(), file.c_str()) == 0 ? 0 : errno;
}

/// The process id at the end of an interim name: `X.db.new-12-0`; none: no interim name.
std::optional<pid_t> owner_in(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string_view::npos || dot == 0) return std::nullopt;
  for (const std::string_view ending : {kNewEnding, kRestoreEnding}) {
    if (!name.substr(dot).starts_with(ending)) continue;
    const std::string_view number = name.substr(dot + ending.size());
    pid_t owner = 0;
    if (algebra3d::is_draft_number(number) &&
        std::from_chars(number.data(), number.data() + number.size(), owner).ec == std::errc())
      return owner;
  }
  return std::nullopt;
}

std::string file_beginning(const fs::path& file, std::size_t count) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);  // NOLINT(*-vararg)
  if (descriptor < 0) return {};
  std::string bytes = first_bytes(descriptor, count);
  ::close(descriptor);
  return bytes;
}

/// Whether an empty file is what a killed process has left: earlier versions let SQLite make the first pages, by way of
/// a journal, which then lies beside it and holds none. An empty file alone may be one of another program.
bool is_empty_leftover(const fs::path& file, bool is_of_this_database, pid_t owner) {
  std::error_code error;
  const auto log_bytes = fs::file_size(file.string() + "-wal", error);
  if (!error && log_bytes > 0) return false;
  const fs::path journal = file.string() + "-journal";
  const auto journal_bytes = fs::file_size(journal, error);
  if (!error && journal_bytes > 0)
    return journal_bytes <= kEmptyJournalBytes && file_beginning(journal, kJournalMagic.size()) == kJournalMagic;
  return is_of_this_database || (::kill(owner, 0) != 0 && errno == ESRCH);
}

/// Whether it has the mark of a draft, and who makes it is alive.
enum class DraftState : std::uint8_t { none, owned, ownerless };

// An ownerless one is finished under the lock that its owner had, so that nobody takes it for a leftover meanwhile.
Result<DraftState> finish_ownerless(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);  // NOLINT(*-vararg)
  if (descriptor < 0) return DraftState::none;                      // reported where the database is opened
  auto state = DraftState::none;
  Status status;
  if (has_draft_mark(descriptor)) state = DraftFile::lock(descriptor) ? DraftState::ownerless : DraftState::owned;
  if (state == DraftState::ownerless && has_draft_mark(descriptor)) status = take_mark_away(file, descriptor);
  ::close(descriptor);
  if (!status) return std::move(status).error();
  return state;
}

}  // namespace

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

Result<DatabaseDraft> DatabaseDraft::create(const fs::path& file, std::string_view ending) {
  A3D_TRY(check_name_length(file));
  A3D_ASSIGN(const std::string bytes, draft_bytes());
  A3D_ASSIGN(DraftFile made, DraftFile::create(file, file.filename().string() + std::string(ending), ""));
  DatabaseDraft draft(file, std::move(made));
  A3D_TRY(write_all(file, draft.draft_.descriptor(), bytes));
  return draft;
}

DatabaseDraft::~DatabaseDraft() {
  if (path().empty()) return;
  for (const char* ending : algebra3d::kSidecarEndings) ::unlink((path().string() + ending).c_str());
  draft_.remove();
}

Status DatabaseDraft::publish(bool replaces_empty) {
  std::error_code error;
  const auto log_bytes = fs::file_size(path().string() + "-wal", error);
  if (!error && log_bytes > 0)
    return Error{ErrorCode::io_error, "the database could not be written completely; is the disk full?"}.about(
        file_.string());
  if (::fsync(draft_.descriptor()) != 0) return write_error(file_, errno);
  const int problem = give_name(path(), file_, replaces_empty);
  if (problem == EEXIST) return Error{ErrorCode::database_exists, "there is a database {} already", file_.string()};
  if (problem != 0) return write_error(file_, problem);
  draft_.remove();
  return take_mark_away(file_, draft_.descriptor());
}

Status finish_database(const fs::path& file, int busy_milliseconds) {
  using Clock = std::chrono::steady_clock;
  constexpr auto kPause = std::chrono::milliseconds(5);
  if (algebra3d::open_database_with(file)) return {};
  const auto end = Clock::now() + std::chrono::milliseconds(busy_milliseconds);
  while (true) {
    A3D_ASSIGN(const DraftState state, finish_ownerless(file));
    if (state != DraftState::owned) return {};
    if (Clock::now() >= end)
      return Error{ErrorCode::database_busy,
                   "another process is still making this database; try again when it has finished"}
          .about(file.string());
    std::this_thread::sleep_for(kPause);
  }
}

void remove_database_leftovers(const fs::path& file) {
  const std::string own = file.filename().string() + ".";
  std::error_code error;
  for (fs::directory_iterator entry(algebra3d::folder_of(file), error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const auto owner = owner_in(name);
    if (!owner) continue;
    algebra3d::remove_if_abandoned(entry->path(), [&](int descriptor) {
      if (has_draft_mark(descriptor)) return true;
      return first_bytes(descriptor, 1).empty() && is_empty_leftover(entry->path(), name.starts_with(own), *owner);
    });
  }
}

}  // namespace queries
