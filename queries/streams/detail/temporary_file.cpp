#include "queries/streams/detail/temporary_file.h"

#include <cerrno>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkostemp is POSIX
#include <unistd.h>

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Status;

namespace {

Error file_error(const std::filesystem::path& folder, int reason) {
  const bool is_full = reason == ENOSPC || reason == EDQUOT;
  return {is_full ? ErrorCode::disk_full : ErrorCode::io_error,
          "temporary file in {}: {}; the environment variable TMPDIR names another folder, and `set \"memory\" = ...` "
          "the megabytes to keep in memory",
          folder.string(), std::generic_category().message(reason)};
}

}  // namespace

Result<std::unique_ptr<TemporaryFile>> TemporaryFile::make(const std::filesystem::path& folder) {
  std::string name = folder / "algebra3d-XXXXXX";
  const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor < 0) return file_error(folder, errno);
  ::unlink(name.c_str());
  return std::unique_ptr<TemporaryFile>(new TemporaryFile(descriptor, folder));
}

TemporaryFile::~TemporaryFile() {
  ::close(descriptor_);
}

Status TemporaryFile::append(std::string_view bytes) {
  while (!bytes.empty()) {
    const auto written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(size_));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return file_error(folder_, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
    size_ += static_cast<std::uint64_t>(written);
  }
  return {};
}

Status TemporaryFile::read(std::uint64_t offset, std::span<char> bytes) const {
  while (!bytes.empty()) {
    const auto count = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return file_error(folder_, errno);
    if (count == 0) return file_error(folder_, EIO);  // somebody has cut it
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    offset += static_cast<std::uint64_t>(count);
  }
  return {};
}

}  // namespace queries
