#include "base/draft_file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <optional>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file_error.h"
#include "base/open_databases.h"

namespace algebra3d {
namespace {

namespace fs = std::filesystem;

constexpr off_t kLockByte = off_t{1} << 62;
// SQLite's locks, https://www.sqlite.org/fileformat.html, section 1.2: of whoever has a file open as a database.
constexpr off_t kSqliteLocks = 0x40000000;
constexpr off_t kSqliteLockBytes = 512;
constexpr int kMostAttempts = 10'000;

bool lock_range(int descriptor, off_t start, off_t length) {
  struct flock range {};
  range.l_type = F_WRLCK;
  range.l_whence = SEEK_SET;
  range.l_start = start;
  range.l_len = length;
  return ::fcntl(descriptor, F_OFD_SETLK, &range) == 0;  // NOLINT(*-vararg)
}

bool is_file_at(const fs::path& path, int descriptor) {
  struct stat named {};
  struct stat open {};
  return ::lstat(path.c_str(), &named) == 0 && ::fstat(descriptor, &open) == 0 && named.st_dev == open.st_dev &&
         named.st_ino == open.st_ino;
}

}  // namespace

// Between creating and locking, another process may take the file for a leftover and remove it; then another one is
// made. Where the file system knows no locks nobody can prove anything, and leftovers stay.
Result<DraftFile> DraftFile::create(const fs::path& target, std::string_view prefix, std::string_view ending) {
  static std::atomic<unsigned> counter = 0;
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    const fs::path path =
        folder_of(target) / fmt::format("{}{}-{}{}", prefix, ::getpid(), counter.fetch_add(1), ending);
    DraftFile draft(path, ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));  // NOLINT(*-vararg)
    if (draft.descriptor_ < 0 && errno == EEXIST) continue;
    if (draft.descriptor_ < 0) return write_error(target, errno);
    const bool has_lock = lock(draft.descriptor_) || (errno != EAGAIN && errno != EACCES);
    if (has_lock && is_file_at(path, draft.descriptor_)) return draft;
  }
  return Error{ErrorCode::io_error, "no interim name is free in its folder"}.about(target.string());
}

DraftFile::DraftFile(DraftFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {
  other.path_.clear();
}

DraftFile& DraftFile::operator=(DraftFile&& other) noexcept {
  path_.swap(other.path_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

DraftFile::~DraftFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void DraftFile::remove() {
  if (descriptor_ >= 0 && !path_.empty() && is_file_at(path_, descriptor_)) ::unlink(path_.c_str());
  path_.clear();
}

bool DraftFile::lock(int descriptor) {
  return lock_range(descriptor, kLockByte, 1);
}

// Looked at before it is locked too, so that a file of somebody else is not locked even for a moment.
void remove_if_abandoned(const fs::path& draft, const std::function<bool(int descriptor)>& is_draft) {
  struct stat facts {};
  if (::lstat(draft.c_str(), &facts) != 0 || !S_ISREG(facts.st_mode) || open_database_with(draft)) return;
  const int descriptor = ::open(draft.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);  // NOLINT(*-vararg)
  if (descriptor < 0) return;
  const bool is_ownerless =
      is_draft(descriptor) && DraftFile::lock(descriptor) && lock_range(descriptor, kSqliteLocks, kSqliteLockBytes);
  if (is_ownerless && is_draft(descriptor) && is_file_at(draft, descriptor)) {
    for (const char* ending : kSidecarEndings) ::unlink((draft.string() + ending).c_str());
    ::unlink(draft.c_str());
  }
  ::close(descriptor);
}

bool is_draft_number(std::string_view text) {
  const auto is_number = [](std::string_view part) {
    return !part.empty() && std::ranges::all_of(part, [](char c) { return c >= '0' && c <= '9'; });
  };
  const std::size_t dash = text.find('-');
  return is_number(text.substr(0, dash)) && (dash == std::string_view::npos || is_number(text.substr(dash + 1)));
}

}  // namespace algebra3d
