#pragma once

#include <cstring>

#include "stl/text.h"

namespace stl {

/// Finds the ends of lines, which may be CR, LF or CRLF, also mixed.
/// Does not own the text, which must outlive it. Cost: linear in the text over all calls, if they go forward.
class LineEnds {
 public:
  explicit LineEnds(const char* end) : end_(end) {}

  /// The first line break at or behind `position`, or the end of the text.
  const char* find(const char* position) {
    // The next LF is kept: a file of CR alone would be searched for one to its end in every line.
    if (line_feed_ == nullptr || line_feed_ < position) line_feed_ = first_in(position, end_, '\n');
    return first_in(position, line_feed_, '\r');
  }

 private:
  static const char* first_in(const char* begin, const char* end, char c) {
    if (begin == end) return end;
    const void* found = std::memchr(begin, c, static_cast<std::size_t>(end - begin));
    return found == nullptr ? end : static_cast<const char*>(found);
  }

  const char* end_;
  const char* line_feed_ = nullptr;
};

}  // namespace stl
