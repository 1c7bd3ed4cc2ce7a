#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "algebra3d/base/error.h"
#include "base/input_file.h"

namespace queries {

/// A text file that is read once, from beginning to end, through a small buffer. A UTF-8 byte order mark at the
/// beginning is skipped. Used by one thread.
class TextFile {
 public:
  static constexpr int kEnd = -1;

  /// Opens a regular file. Errors: those of algebra3d::InputFile::open; file_format (the byte order mark of UTF-16).
  static algebra3d::Result<TextFile> open(const std::filesystem::path& path);

  /// The state of the file when it was opened.
  const algebra3d::FileState& state() const { return file_.state(); }
  /// Checks that the file has not changed since `earlier`, if given. Errors: io_error.
  algebra3d::Status check_state(const std::optional<algebra3d::FileState>& earlier) const;
  /// The next byte, or kEnd at the end and after a read error; check `status` then.
  int peek() { return position_ < end_ || fill() ? static_cast<unsigned char>(buffer_[position_]) : kEnd; }
  int take() {
    const int next = peek();
    if (next != kEnd) ++position_;
    return next;
  }
  /// Line of the next byte from 1, if `count_line` was called for each line end.
  std::size_t line() const { return line_; }
  void count_line() { ++line_; }
  /// The error of reading, if any: io_error, also if the file was changed before its end was reached.
  const algebra3d::Status& status() const { return status_; }

 private:
  explicit TextFile(algebra3d::InputFile file) : file_(std::move(file)) {}
  bool fill();
  algebra3d::Status skip_byte_order_mark();

  algebra3d::InputFile file_;
  std::size_t offset_ = 0;  // in the file, of the first byte after the buffer
  std::string buffer_;
  std::size_t position_ = 0, end_ = 0;
  std::size_t line_ = 1;
  algebra3d::Status status_;
};

}  // namespace queries
