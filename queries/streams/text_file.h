#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "algebra3d/base/error.h"
#include "stl/input_file.h"

namespace queries {

/// A text file that is read once, from its beginning to its end, a piece at a time: so a large file takes no memory.
/// A byte order mark of UTF-8 at its beginning is skipped. Used by one thread.
class TextFile {
 public:
  static constexpr int kEnd = -1;

  /// Domain: a regular file. Errors: those of stl::InputFile::open; file_format (the byte order mark of UTF-16).
  static algebra3d::Result<TextFile> open(const std::filesystem::path& path);

  /// As it was when the file was opened.
  const stl::FileState& state() const { return file_.state(); }
  /// Errors: io_error if there is an earlier state that is another one.
  algebra3d::Status check_state(const std::optional<stl::FileState>& earlier) const;
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
  /// Errors: io_error if reading has failed, or if the end was reached and the file has been changed meanwhile.
  const algebra3d::Status& status() const { return status_; }

 private:
  explicit TextFile(stl::InputFile file) : file_(std::move(file)) {}
  bool fill();
  algebra3d::Status skip_byte_order_mark();

  stl::InputFile file_;
  std::size_t offset_ = 0;  // in the file, of what comes behind the buffer
  std::string buffer_;
  std::size_t position_ = 0, end_ = 0;
  std::size_t line_ = 1;
  algebra3d::Status status_;
};

}  // namespace queries
