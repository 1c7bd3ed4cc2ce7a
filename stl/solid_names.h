#pragma once

#include "stl/ascii_cursor.h"

namespace stl {

inline constexpr Keyword kSolid("solid");
inline constexpr Keyword kEndsolid("endsolid");
inline constexpr Keyword kFacet("facet");
inline constexpr Keyword kNormal("normal");
inline constexpr Keyword kOuter("outer");

/// Goes behind `joined` (say `endloop`), or behind `end` and `second` (`loop`) in two words, if they are here.
bool take_end(AsciiCursor& cursor, const Keyword& joined, const Keyword& second);

/// Finds where the names behind `solid` and `endsolid` end; the rule stands at `read_ascii`.
/// Does not own the text, which must outlive it. Cost: linear in the text over all calls, if they go forward.
class SolidNames {
 public:
  SolidNames(const char* begin, const char* end) : end_(end), line_begin_(begin), next_(end, end) {}

  /// `name` stands right behind the keyword; the result is at most the end of its line.
  const char* end_of_solid_name(const char* name);
  const char* end_of_endsolid_name(const char* name);

 private:
  void load_line(const char* position);
  bool ends_a_solid(AsciiCursor word);

  const char* end_;
  // The line found last, and the first word behind it: a file can be one line with a million names in it.
  const char* line_begin_;
  const char* line_end_ = nullptr;
  AsciiCursor next_;
};

}  // namespace stl
