#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include <time.h>  // NOLINT(modernize-deprecated-headers): timespec is POSIX

#include "algebra3d/base/error.h"

namespace algebra3d {

/// An owning file descriptor; below 0 for none.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor();
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

/// Size and modification time of a file, to detect changes.
struct FileState {
  std::size_t size = 0;
  timespec changed = {};

  friend bool operator==(const FileState& a, const FileState& b) {
    return a.size == b.size && a.changed.tv_sec == b.changed.tv_sec && a.changed.tv_nsec == b.changed.tv_nsec;
  }
};

/// A regular file that is open for reading. If another process changes the file meanwhile, functions that read all of
/// it return an error, since old and new bytes do not belong together. Concurrent reading is safe.
class InputFile {
 public:
  /// Opens a regular file; folders, pipes and devices are refused. Errors: file_missing (no such file, none that
  /// may be read, none of data), io_error (all others), with the path and the system's reason.
  static Result<InputFile> open(const std::filesystem::path& path);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::size_t size() const { return state_.size; }
  /// The state when the file was opened.
  [[nodiscard]] const FileState& state() const { return state_; }

  /// Reads up to `count` bytes to `buffer`; fewer only at the end of the file. Errors: io_error.
  [[nodiscard]] Result<std::size_t> read_at(std::size_t offset, char* buffer, std::size_t count) const;
  /// Errors: io_error if the file has changed since it was opened, with the kind of change.
  [[nodiscard]] Status check_unchanged() const;
  /// The first `count` bytes, or all if there are fewer. Errors: io_error.
  [[nodiscard]] Result<std::string> head(std::size_t count) const;

  using TakeBlock = std::function<Status(std::string_view block)>;
  /// Calls `take` with all bytes in order, in blocks that are valid during the call. Errors: io_error, if reading fails
  /// or the file has changed since it was opened; interrupted, if `*cancel` is set; those of `take`.
  Status for_each_block(const std::atomic<bool>* cancel, const TakeBlock& take) const;
  /// Reads all `size()` bytes to `buffer`. Errors: as before.
  Status read_into(char* buffer, const std::atomic<bool>* cancel) const;

  /// Number of bytes in holes of a sparse file, as far as the file system reports them; they read as zeros. Stops
  /// counting at `enough`. Cost: linear in the holes counted.
  [[nodiscard]] std::uint64_t hole_bytes(std::uint64_t enough) const;

 private:
  InputFile(Descriptor file, std::filesystem::path path, FileState state)
      : file_(std::move(file)), path_(std::move(path)), state_(state) {}
  [[nodiscard]] Status ends_early(std::size_t offset) const;

  Descriptor file_;
  std::filesystem::path path_;
  FileState state_;
};

}  // namespace algebra3d
