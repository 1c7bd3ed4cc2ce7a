#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "algebra3d/base/error.h"

namespace queries {

/// A text file that is read once, from its beginning to its end, a piece at a time: so a large file takes no memory,
/// and one that another process cuts short ends early. A byte order mark of UTF-8 at its beginning is skipped. Used by
/// one thread.
class TextFile {
 public:
  static constexpr int kEnd = -1;

  /// Domain: a regular file. Errors: file_missing, io_error (a folder, a pipe, no permission, part of the open
  /// database), file_format (the byte order mark of UTF-16); all name the path.
  static algebra3d::Result<TextFile> open(const std::filesystem::path& path);

  TextFile(TextFile&& other) noexcept;
  TextFile& operator=(TextFile&& other) noexcept;
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  ~TextFile();

  /// The next byte, or kEnd, which stays. An error of reading looks like the end: ask `status` there.
  int peek() { return position_ < end_ || fill() ? static_cast<unsigned char>(buffer_[position_]) : kEnd; }
  int take() {
    const int next = peek();
    if (next != kEnd) ++position_;
    return next;
  }
  /// Line of the next byte from 1, if `count_line` was called for each line end.
  std::size_t line() const { return line_; }
  void count_line() { ++line_; }
  /// Errors: io_error if reading has failed.
  algebra3d::Status status() const;

 private:
  TextFile(int descriptor, std::filesystem::path path) : descriptor_(descriptor), path_(std::move(path)) {}
  bool fill();
  algebra3d::Status skip_byte_order_mark();

  int descriptor_ = -1;
  std::filesystem::path path_;
  std::string buffer_;
  std::size_t position_ = 0, end_ = 0;
  std::size_t line_ = 1;
  int failure_ = 0;
};

}  // namespace queries
