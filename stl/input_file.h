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

namespace stl {

/// The owner of a file descriptor; below 0 for none.
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

/// What tells that a file was written to: its size, and the time of its last change.
struct FileState {
  std::size_t size = 0;
  timespec changed = {};

  friend bool operator==(const FileState& a, const FileState& b) {
    return a.size == b.size && a.changed.tv_sec == b.changed.tv_sec && a.changed.tv_nsec == b.changed.tv_nsec;
  }
};

/// A regular file that is open for reading, and its size when it was opened.
/// Another process may change the file meanwhile: what reads all of it tells that as an error (by size and time of
/// change), since bytes from before and after do not belong together. Reading from several threads is safe.
class InputFile {
 public:
  /// Opens the file at `path`. Domain: a regular file, also an empty one; folders, pipes and devices are refused.
  /// Errors: file_missing (no such file), io_error (everything else); both name the path and the system's reason.
  static algebra3d::Result<InputFile> open(const std::filesystem::path& path);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::size_t size() const { return state_.size; }
  /// As it was when the file was opened.
  [[nodiscard]] const FileState& state() const { return state_; }

  /// Reads up to `count` bytes to `room`; fewer only at the end of the file. Errors: io_error.
  [[nodiscard]] algebra3d::Result<std::size_t> read_at(std::size_t offset, char* room, std::size_t count) const;
  /// Errors: io_error if the file was changed since it was opened; says how.
  [[nodiscard]] algebra3d::Status check_unchanged() const;
  /// The first bytes, `count` of them or as many as there are. Errors: io_error.
  [[nodiscard]] algebra3d::Result<std::string> head(std::size_t count) const;

  using TakeBlock = std::function<algebra3d::Status(std::string_view block)>;
  /// Hands over all bytes in their order, in blocks that live for the call only.
  /// Errors: io_error, if reading fails, or if the file was changed since it was opened; interrupted, if `*cancel` was
  /// set; those of `take`.
  algebra3d::Status for_each_block(const std::atomic<bool>* cancel, const TakeBlock& take) const;
  /// Reads all `size()` bytes to `room`. Errors: as before.
  algebra3d::Status read_into(char* room, const std::atomic<bool>* cancel) const;

  /// How many bytes were never written (holes of a sparse file), as far as the file system tells; they read as zeros.
  /// Counts until `enough` of them are found. Cost: grows with the number of holes before that.
  [[nodiscard]] std::uint64_t hole_bytes(std::uint64_t enough) const;

 private:
  InputFile(Descriptor file, std::filesystem::path path, FileState state)
      : file_(std::move(file)), path_(std::move(path)), state_(state) {}
  [[nodiscard]] algebra3d::Status ends_early(std::size_t offset) const;

  Descriptor file_;
  std::filesystem::path path_;
  FileState state_;
};

}  // namespace stl
