#include "base/input_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "base/file_error.h"
#include "base/open_databases.h"
#include "base/propagate.h"

namespace algebra3d {

namespace {

/// Large enough that system calls do not count, small enough that an interruption is soon noticed.
constexpr std::size_t kBlockBytes = std::size_t{4} << 20;

// Reasons that another name or other permissions would mend are file_missing, failures of the device io_error.
Error reading_error(const std::filesystem::path& path, int reason) {
  constexpr std::array kOfTheName = {ENOENT, ENOTDIR, EISDIR, EACCES, EPERM, ELOOP, ENAMETOOLONG};
  const bool is_of_the_name = std::ranges::find(kOfTheName, reason) != kOfTheName.end();
  std::error_code not_a_link;
  const std::filesystem::path target = std::filesystem::read_symlink(path, not_a_link);
  const std::string why = reason == ENOENT && !not_a_link
                              ? fmt::format("it is a link to '{}', which does not exist", target.string())
                              : std::generic_category().message(reason);
  return Error{is_of_the_name ? ErrorCode::file_missing : ErrorCode::io_error, "{}", why}.about(path.string());
}

FileState state_of(const struct stat& facts) {
  return {static_cast<std::size_t>(facts.st_size), facts.st_mtim};
}

bool is_set(const std::atomic<bool>* cancel) {
  return cancel != nullptr && cancel->load(std::memory_order_relaxed);
}

}  // namespace

Descriptor::Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

Result<InputFile> InputFile::open(const std::filesystem::path& path) {
  A3D_TRY(check_file_name(path));
  if (const auto database = open_database_with(path))
    return Error{ErrorCode::file_missing, "this file holds the open database '{}'", database->string()}.about(
        path.string());
  // O_NONBLOCK: opening a pipe that nobody writes to must not wait for a writer.
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));  // NOLINT(*-vararg)
  if (file.number() < 0) return reading_error(path, errno);
  struct stat facts {};
  if (::fstat(file.number(), &facts) != 0) return reading_error(path, errno);
  if (S_ISDIR(facts.st_mode)) return reading_error(path, EISDIR);
  if (!S_ISREG(facts.st_mode))
    return Error{ErrorCode::file_missing, "Not a regular file (but a pipe or device)"}.about(path.string());
  ::posix_fadvise(file.number(), 0, 0, POSIX_FADV_SEQUENTIAL);  // a hint: reads ahead in larger steps
  return InputFile(std::move(file), path, state_of(facts));
}

Result<std::size_t> InputFile::read_at(std::size_t offset, char* buffer, std::size_t count) const {
  std::size_t done = 0;
  while (done < count) {
    const auto read = ::pread(file_.number(), buffer + done, count - done, static_cast<off_t>(offset + done));
    if (read < 0 && errno == EINTR) continue;
    if (read < 0) return reading_error(path_, errno);
    if (read == 0) break;
    done += static_cast<std::size_t>(read);
  }
  return done;
}

Result<std::string> InputFile::head(std::size_t count) const {
  std::string bytes(std::min(count, state_.size), '\0');
  A3D_ASSIGN(const std::size_t found, read_at(0, bytes.data(), bytes.size()));
  bytes.resize(found);
  return bytes;
}

Status InputFile::check_unchanged() const {
  struct stat facts {};
  if (::fstat(file_.number(), &facts) != 0) return reading_error(path_, errno);
  const FileState now = state_of(facts);
  if (now == state_) return {};
  const std::string how = now.size == state_.size
                              ? "another process wrote to it"
                              : fmt::format("it had {} bytes, and has {} now", state_.size, now.size);
  return Error{ErrorCode::io_error, "the file was changed while it was read: {}", how}.about(path_.string());
}

Status InputFile::ends_early(std::size_t offset) const {
  A3D_TRY(check_unchanged());
  return Error{ErrorCode::io_error, "reading ends at byte {}; expected {} bytes", offset, state_.size}.about(
      path_.string());
}

Status InputFile::for_each_block(const std::atomic<bool>* cancel, const TakeBlock& take) const {
  const std::size_t block_bytes = std::min(kBlockBytes, state_.size);
  const auto block = std::make_unique_for_overwrite<char[]>(block_bytes);  // NOLINT(*-avoid-c-arrays)
  for (std::size_t offset = 0; offset < state_.size;) {
    if (is_set(cancel)) return interrupted_reading(path_.string());
    A3D_ASSIGN(const std::size_t found, read_at(offset, block.get(), std::min(block_bytes, state_.size - offset)));
    if (found == 0) return ends_early(offset);
    A3D_TRY(take({block.get(), found}));
    offset += found;
  }
  return check_unchanged();
}

Status InputFile::read_into(char* buffer, const std::atomic<bool>* cancel) const {
  for (std::size_t offset = 0; offset < state_.size;) {
    if (is_set(cancel)) return interrupted_reading(path_.string());
    A3D_ASSIGN(const std::size_t found, read_at(offset, buffer + offset, std::min(kBlockBytes, state_.size - offset)));
    if (found == 0) return ends_early(offset);
    offset += found;
  }
  return check_unchanged();
}

std::uint64_t InputFile::hole_bytes(std::uint64_t enough) const {
  std::uint64_t sum = 0;
  const auto end = static_cast<off_t>(state_.size);
  for (off_t position = 0; position < end && sum < enough;) {
    const off_t hole = ::lseek(file_.number(), position, SEEK_HOLE);
    if (hole < 0 || hole >= end) break;
    const off_t data = ::lseek(file_.number(), hole, SEEK_DATA);  // fails with ENXIO where the rest is a hole
    position = data < 0 ? end : std::min(data, end);
    sum += static_cast<std::uint64_t>(position - hole);
  }
  return sum;
}

}  // namespace algebra3d
