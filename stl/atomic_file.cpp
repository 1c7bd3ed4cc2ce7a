#include "stl/atomic_file.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace stl {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Status;

namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 20;

Error path_error(const std::filesystem::path& path, int reason) {
  ErrorCode code = ErrorCode::io_error;
  if (reason == ENOSPC || reason == EDQUOT) code = ErrorCode::disk_full;
  if (reason == ENOENT || reason == ENOTDIR) code = ErrorCode::file_missing;
  return {code, "{}: {}", path.string(), std::generic_category().message(reason)};
}

// Hidden, so that a pattern like *.stl never takes up a file that is being written.
std::filesystem::path temporary_name(const std::filesystem::path& folder) {
  static std::atomic<unsigned> counter = 0;
  return folder / fmt::format(".writing-{}-{}.tmp", ::getpid(), counter.fetch_add(1));
}

Status write_all(int descriptor, const char* bytes, std::size_t size, const std::filesystem::path& path) {
  while (size > 0) {
    const auto written = ::write(descriptor, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return path_error(path, errno);
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
  return {};
}

// The name of a new file is safe only once its folder is on disk. Some file systems cannot do this for folders; the
// file itself is whole by then, so that is no error.
void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);  // NOLINT(*-vararg)
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

// SQLite's databases begin like this, and so do ours.
bool is_database(const std::filesystem::path& file) {
  constexpr std::string_view kBeginning("SQLite format 3\0", 16);
  std::string beginning(kBeginning.size(), '\0');
  std::ifstream stream(file, std::ios::binary);
  return stream.read(beginning.data(), static_cast<std::streamsize>(beginning.size())) && beginning == kBeginning;
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

}  // namespace

Result<AtomicFile> AtomicFile::create(const std::filesystem::path& path) {
  if (path.empty()) return Error{ErrorCode::io_error, "the file name is empty"};
  AtomicFile file;
  file.path_ = path;
  std::error_code error;
  // A link that leads nowhere is followed too: its target is what gets created.
  file.target_ = std::filesystem::is_symlink(path, error) ? std::filesystem::weakly_canonical(path, error) : path;
  if (error && error.value() != ENOENT) return path_error(path, error.value());
  struct stat facts {};
  const bool exists = ::stat(file.target_.c_str(), &facts) == 0;
  if (!exists && errno != ENOENT) return path_error(path, errno);
  if (exists && S_ISDIR(facts.st_mode)) return path_error(path, EISDIR);
  if (exists && !S_ISREG(facts.st_mode))
    return Error{ErrorCode::io_error, "{}: Not a regular file (but a pipe or device)", path.string()};
  if (exists && is_database(file.target_))
    return Error{ErrorCode::wrong_usage, "{}: this file is a database, which no other file replaces", path.string()};
  // Renaming needs no right to write the file that it replaces, but whoever protected a file means it.
  if (exists && ::access(file.target_.c_str(), W_OK) != 0) return path_error(path, errno);
  const std::filesystem::path temporary = temporary_name(folder_of(file.target_));
  file.descriptor_ = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);  // NOLINT(*-vararg)
  if (file.descriptor_ < 0) return path_error(path, errno);
  file.temporary_ = temporary;
  if (exists && ::fchmod(file.descriptor_, facts.st_mode & 0777) != 0) return path_error(path, errno);
  file.buffer_ = std::make_unique<char[]>(kBufferBytes);
  return file;
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::move(other.temporary_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      buffer_(std::move(other.buffer_)),
      buffered_(std::exchange(other.buffered_, 0)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  path_.swap(other.path_);
  target_.swap(other.target_);
  temporary_.swap(other.temporary_);
  std::swap(descriptor_, other.descriptor_);
  buffer_.swap(other.buffer_);
  std::swap(buffered_, other.buffered_);
  return *this;
}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(temporary_.c_str());
}

Status AtomicFile::append(std::string_view bytes) {
  if (bytes.size() > kBufferBytes - buffered_) RETURN_IF_ERROR(flush());
  if (bytes.size() > kBufferBytes) return write_all(descriptor_, bytes.data(), bytes.size(), path_);
  std::memcpy(buffer_.get() + buffered_, bytes.data(), bytes.size());
  buffered_ += bytes.size();
  return {};
}

Status AtomicFile::flush() {
  return write_all(descriptor_, buffer_.get(), std::exchange(buffered_, 0), path_);
}

Status AtomicFile::commit() {
  RETURN_IF_ERROR(flush());
  if (::fsync(descriptor_) != 0) return path_error(path_, errno);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) return path_error(path_, errno);
  // From here on the file stands; the network file systems that report a full disk only on closing did so on fsync.
  ::close(std::exchange(descriptor_, -1));
  sync_folder(folder_of(target_));
  return {};
}

}  // namespace stl
