#include "queries/streams/text_file.h"

#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "algebra3d/base/open_databases.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Status;

namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 18U;

Error text_file_error(const std::filesystem::path& path, int reason) {
  const bool is_missing = reason == ENOENT || reason == ENOTDIR;
  return {is_missing ? ErrorCode::file_missing : ErrorCode::io_error, "{}: {}", path.string(),
          std::generic_category().message(reason)};
}

}  // namespace

Result<TextFile> TextFile::open(const std::filesystem::path& path) {
  if (const auto database = algebra3d::open_database_with(path))
    return Error{ErrorCode::io_error, "{}: this file holds the open database '{}'", path.string(), database->string()};
  // O_NONBLOCK: opening a pipe that nobody writes to must not wait for a writer.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // NOLINT(*-vararg)
  if (descriptor < 0) return text_file_error(path, errno);
  TextFile file(descriptor, path);
  struct stat facts {};
  if (::fstat(descriptor, &facts) != 0) return text_file_error(path, errno);
  if (S_ISDIR(facts.st_mode)) return text_file_error(path, EISDIR);
  if (!S_ISREG(facts.st_mode))
    return Error{ErrorCode::io_error, "{}: Not a regular file (but a pipe or device)", path.string()};
  RETURN_IF_ERROR(file.skip_byte_order_mark());
  return file;
}

TextFile::TextFile(TextFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      path_(std::move(other.path_)),
      buffer_(std::move(other.buffer_)),
      position_(std::exchange(other.position_, 0)),
      end_(std::exchange(other.end_, 0)),
      line_(other.line_),
      failure_(other.failure_) {}

TextFile& TextFile::operator=(TextFile&& other) noexcept {
  TextFile taken(std::move(other));
  std::swap(descriptor_, taken.descriptor_);
  std::swap(path_, taken.path_);
  std::swap(buffer_, taken.buffer_);
  std::swap(position_, taken.position_);
  std::swap(end_, taken.end_);
  std::swap(line_, taken.line_);
  std::swap(failure_, taken.failure_);
  return *this;
}

TextFile::~TextFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool TextFile::fill() {
  if (descriptor_ < 0 || failure_ != 0) return false;
  buffer_.resize(kPieceBytes);
  ssize_t count = 0;
  do count = ::read(descriptor_, buffer_.data(), buffer_.size());
  while (count < 0 && errno == EINTR);
  if (count < 0) failure_ = errno;
  position_ = 0;
  end_ = count > 0 ? static_cast<std::size_t>(count) : 0;
  return end_ > 0;
}

Status TextFile::status() const {
  if (failure_ != 0) return text_file_error(path_, failure_);
  return {};
}

Status TextFile::skip_byte_order_mark() {
  if (!fill()) return status();
  const std::string_view front(buffer_.data(), end_);
  if (front.starts_with("\xff\xfe") || front.starts_with("\xfe\xff"))
    return Error{ErrorCode::file_format,
                 "line 1: expected UTF-8, found UTF-16; convert it with iconv -f UTF-16 -t UTF-8"};
  if (front.starts_with("\xef\xbb\xbf")) position_ = 3;
  return {};
}

}  // namespace queries
