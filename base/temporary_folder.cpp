#include "base/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/draft_file.h"

namespace algebra3d {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFolderPrefix = "algebra3d-";
constexpr std::string_view kFolderPattern = "XXXXXX";
constexpr const char* kLockFile = ".algebra3d-temporary-folder";
constexpr const char* kContent = "files";
constexpr int kMostTries = 100;

fs::path lock_file_of(const fs::path& outer) {
  return outer / kLockFile;
}

// The file proves that the folder is one of ours.
Descriptor opened_lock_file(const fs::path& outer, int flags) {
  // NOLINTNEXTLINE(*-vararg)
  return Descriptor(::open(lock_file_of(outer).c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | flags, 0600));
}

bool is_there(const fs::path& file, const Descriptor& opened) {
  struct stat named {};
  struct stat open {};
  return ::lstat(file.c_str(), &named) == 0 && ::fstat(opened.number(), &open) == 0 && named.st_dev == open.st_dev &&
         named.st_ino == open.st_ino;
}

// The lock file goes last but one, so that an interrupted removal can be taken up again.
void remove_all_of(const fs::path& outer) {
  std::error_code ignored;  // a destructor cannot report errors
  fs::remove_all(outer / kContent, ignored);
  fs::remove(lock_file_of(outer), ignored);
  fs::remove(outer, ignored);
}

bool has_name_of_folder(const std::string& name) {
  return name.starts_with(kFolderPrefix) && name.size() == kFolderPrefix.size() + kFolderPattern.size();
}

bool is_own_folder(const fs::path& outer) {
  struct stat facts {};
  return ::lstat(outer.c_str(), &facts) == 0 && S_ISDIR(facts.st_mode) && facts.st_uid == ::geteuid();
}

// Once for each parent.
void remove_leftovers_once(const fs::path& parent) {
  static std::mutex mutex;
  static std::set<fs::path> seen;
  {
    const std::lock_guard lock(mutex);
    if (!seen.insert(parent).second) return;
  }
  TemporaryFolder::remove_leftovers(parent);
}

}  // namespace

TemporaryFolder::TemporaryFolder(fs::path outer, Descriptor lock)
    : outer_(std::move(outer)), content_(outer_ / kContent), lock_(std::move(lock)) {}

TemporaryFolder::TemporaryFolder(TemporaryFolder&& other) noexcept
    : outer_(std::exchange(other.outer_, {})),
      content_(std::exchange(other.content_, {})),
      lock_(std::move(other.lock_)) {}

TemporaryFolder& TemporaryFolder::operator=(TemporaryFolder&& other) noexcept {
  outer_.swap(other.outer_);
  content_.swap(other.content_);
  std::swap(lock_, other.lock_);
  return *this;
}

TemporaryFolder::~TemporaryFolder() {
  if (!outer_.empty()) remove_all_of(outer_);
}

void TemporaryFolder::keep() {
  std::error_code ignored;
  fs::remove(lock_file_of(outer_), ignored);
  outer_.clear();
}

// Between making and locking the file another process may take it for a leftover: then the next folder is tried. Where
// the file system knows no locks nobody can prove anything, and leftovers stay.
Result<TemporaryFolder> TemporaryFolder::make(const fs::path& parent) {
  remove_leftovers_once(parent);
  std::string name;
  for (int tries = 0; tries < kMostTries; ++tries) {
    name = (parent / fmt::format("{}{}", kFolderPrefix, kFolderPattern)).string();
    if (::mkdtemp(name.data()) == nullptr) break;
    const fs::path outer = name;
    Descriptor lock = opened_lock_file(outer, O_CREAT | O_EXCL);
    if (lock.number() < 0) {
      const int reason = errno;
      remove_all_of(outer);
      errno = reason;
      break;
    }
    const bool is_locked = DraftFile::lock(lock.number()) || (errno != EAGAIN && errno != EACCES);
    if (!is_locked || !is_there(lock_file_of(outer), lock)) continue;
    TemporaryFolder made(outer, std::move(lock));
    if (::mkdir(made.content_.c_str(), 0700) != 0) break;
    return made;
  }
  return Error{ErrorCode::io_error, "the temporary folder '{}' cannot be made: {}", name,
               std::generic_category().message(errno)};
}

void TemporaryFolder::remove_leftovers(const fs::path& parent) {
  std::error_code error;
  for (fs::directory_iterator entry(parent, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    const fs::path& outer = entry->path();
    if (!has_name_of_folder(outer.filename().string()) || !is_own_folder(outer)) continue;
    const Descriptor lock = opened_lock_file(outer, 0);
    if (lock.number() >= 0 && DraftFile::lock(lock.number()) && is_there(lock_file_of(outer), lock))
      remove_all_of(outer);
  }
}

}  // namespace algebra3d
