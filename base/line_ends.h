#pragma once

#include <cstring>

#include "base/text.h"

namespace algebra3d {

/// Finds line breaks: CR, LF or CRLF, also mixed. The text must outlive it. Cost: linear in the text for all calls
/// together, if positions ascend.
class LineEnds {
 public:
  explicit LineEnds(const char* end) : end_(end) {}

  /// The first line break at or after `position`, or the end of the text.
  const char* find(const char* position) {
    // The next LF is cached: in a file with CR only, every line would search to the end of the file.
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

}  // namespace algebra3d
