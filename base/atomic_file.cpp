#include "base/atomic_file.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/detail/database_part.h"
#include "base/file_error.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBufferBytes = std::size_t{1} << 20;
// Hidden, so that a pattern like *.stl never takes up a file that is being written.
constexpr std::string_view kDraftPrefix = ".writing-";
constexpr std::string_view kDraftEnding = ".tmp";

Status write_all(int descriptor, const char* bytes, std::size_t size, const fs::path& path) {
  while (size > 0) {
    const auto written = ::write(descriptor, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return write_error(path, errno);
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
  return {};
}

// The name of a new file is safe only once its folder is on disk. Some file systems cannot do this for folders; the
// file itself is whole by then, so that is not an error.
void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);  // NOLINT(*-vararg)
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

bool is_draft(std::string_view name) {
  if (!name.starts_with(kDraftPrefix) || !name.ends_with(kDraftEnding)) return false;
  name.remove_prefix(kDraftPrefix.size());
  name.remove_suffix(kDraftEnding.size());
  return is_draft_number(name);
}

// A database may have any name, that of a draft too; no export begins as one does.
bool is_no_database(int descriptor) {
  constexpr std::string_view kDatabaseMagic("SQLite format 3\0", 16);
  std::array<char, kDatabaseMagic.size()> bytes{};
  const ssize_t size = ::pread(descriptor, bytes.data(), bytes.size(), 0);
  return size >= 0 && std::string_view(bytes.data(), static_cast<std::size_t>(size)) != kDatabaseMagic;
}

// Once for each folder: a program that writes ten thousand files into one must not read its names as often.
void remove_leftovers(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<std::pair<dev_t, ino_t>> seen;
  struct stat facts {};
  if (::stat(folder.c_str(), &facts) != 0) return;
  {
    const std::lock_guard lock(mutex);
    if (!seen.emplace(facts.st_dev, facts.st_ino).second) return;
  }
  std::error_code error;
  for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator(); entry.increment(error))
    if (is_draft(entry->path().filename().string())) remove_if_abandoned(entry->path(), is_no_database);
}

// Renames unless the new name is taken (EEXIST). File systems that cannot do that at once, such as NFS, have links.
bool rename_to_new(const fs::path& from, const fs::path& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return true;
  if (errno != EINVAL && errno != ENOSYS) return false;
  return ::link(from.c_str(), to.c_str()) == 0 && ::unlink(from.c_str()) == 0;
}

/// The file that a path means, whether it is there or not: links are followed to their end.
Result<fs::path> target_of(const fs::path& path) {
  constexpr int kMostLinks = 40;  // as the system
  fs::path target = path;
  std::error_code error;
  for (int links = 0; fs::is_symlink(target, error); ++links) {
    if (links == kMostLinks) return write_error(path, ELOOP);
    const fs::path next = fs::read_symlink(target, error);
    if (error) return write_error(path, error.value());
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return target;
}

}  // namespace

// Looked at again just before the file gets its name: a database may have come there meanwhile.
Status AtomicFile::check_replaceable() const {
  const auto kept = database_part(target_);
  if (!kept) return {};
  return Error{ErrorCode::wrong_usage, *kept}.about(path_.string());
}

Result<AtomicFile> AtomicFile::create(const OutputPath& path) {
  const fs::path& given = path.path();
  A3D_TRY(check_file_name(given));
  A3D_TRY(path.check_free());
  AtomicFile file;
  file.path_ = given;
  file.may_replace_ = path.may_replace();
  file.monitor_ = Monitor(path.cancel());
  A3D_ASSIGN(file.target_, target_of(given));
  struct stat facts {};
  const bool exists = ::stat(file.target_.c_str(), &facts) == 0;
  if (!exists && errno != ENOENT) return write_error(given, errno);
  if (exists && S_ISDIR(facts.st_mode)) return write_error(given, EISDIR);
  if (exists && !S_ISREG(facts.st_mode))
    return Error{ErrorCode::io_error, "Not a regular file (but a pipe or device)"}.about(given.string());
  A3D_TRY(file.check_replaceable());
  // Renaming needs no right to write the file that it replaces, but whoever protected a file means it.
  if (exists && ::access(file.target_.c_str(), W_OK) != 0) return write_error(file.target_, errno);
  remove_leftovers(folder_of(file.target_));
  A3D_ASSIGN(auto draft, DraftFile::create(file.target_, kDraftPrefix, kDraftEnding));
  file.draft_ = std::move(draft);
  if (exists && ::fchmod(file.draft_->descriptor(), facts.st_mode & 0777) != 0) return write_error(given, errno);
  file.buffer_ = std::make_unique<char[]>(kBufferBytes);
  return file;
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      may_replace_(other.may_replace_),
      monitor_(other.monitor_),
      target_(std::move(other.target_)),
      draft_(std::exchange(other.draft_, std::nullopt)),
      buffer_(std::move(other.buffer_)),
      buffered_(std::exchange(other.buffered_, 0)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  path_.swap(other.path_);
  std::swap(may_replace_, other.may_replace_);
  std::swap(monitor_, other.monitor_);
  target_.swap(other.target_);
  draft_.swap(other.draft_);
  buffer_.swap(other.buffer_);
  std::swap(buffered_, other.buffered_);
  return *this;
}

AtomicFile::~AtomicFile() {
  if (draft_) draft_->remove();
}

Status AtomicFile::append(std::string_view bytes) {
  if (bytes.size() > kBufferBytes - buffered_) A3D_TRY(flush());
  if (bytes.size() > kBufferBytes) return write_all(draft_->descriptor(), bytes.data(), bytes.size(), path_);
  std::memcpy(buffer_.get() + buffered_, bytes.data(), bytes.size());
  buffered_ += bytes.size();
  return {};
}

Status AtomicFile::flush() {
  A3D_TRY(monitor_.check());
  return write_all(draft_->descriptor(), buffer_.get(), std::exchange(buffered_, 0), path_);
}

// A new file never replaces one that another process made meanwhile: that is an error.
Status AtomicFile::give_name() const {
  const fs::path& draft = draft_->path();
  const bool is_named = may_replace_ ? ::rename(draft.c_str(), target_.c_str()) == 0 : rename_to_new(draft, target_);
  if (is_named) return {};
  return errno == EEXIST ? not_replaced(path_) : write_error(path_, errno);
}

Status AtomicFile::commit() {
  A3D_TRY(flush());
  if (::fsync(draft_->descriptor()) != 0) return write_error(path_, errno);
  A3D_TRY(check_replaceable());
  A3D_TRY(give_name());
  // From here on the file stands; the network file systems that report a full disk only on closing did so on fsync.
  draft_.reset();
  sync_folder(folder_of(target_));
  return {};
}

// Errors of the file name it already.
Status write_file(const OutputPath& path, const std::function<Status(ByteSink&)>& write) {
  A3D_ASSIGN(AtomicFile file, AtomicFile::create(path));
  Status written = write(file);
  if (written) return file.commit();
  const bool is_of_content = written.error().subject.empty() && written.error().code != ErrorCode::interrupted;
  return is_of_content ? std::move(written).error().about(path.path().string()) : std::move(written).error();
}

}  // namespace algebra3d
