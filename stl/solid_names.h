#pragma once

#include "base/ascii_cursor.h"

namespace mesh_formats {

inline constexpr algebra3d::Keyword kSolid("solid");
inline constexpr algebra3d::Keyword kEndsolid("endsolid");
inline constexpr algebra3d::Keyword kFacet("facet");
inline constexpr algebra3d::Keyword kNormal("normal");
inline constexpr algebra3d::Keyword kOuter("outer");

/// Skips `joined` (as `endloop`), or the two words `end` and `second` (`loop`), if they are next.
bool take_end(algebra3d::AsciiCursor& cursor, const algebra3d::Keyword& joined, const algebra3d::Keyword& second);

/// Finds the ends of the names after `solid` and `endsolid`, by the rule at `read_ascii`. The text must outlive it.
/// Cost: linear in the text for all calls together, if positions ascend.
class SolidNames {
 public:
  SolidNames(const char* begin, const char* end) : end_(end), line_begin_(begin), next_(end, end) {}

  /// `name`: the position directly after the keyword. The result is at most the end of its line.
  const char* end_of_solid_name(const char* name);
  const char* end_of_endsolid_name(const char* name);

 private:
  void load_line(const char* position);
  bool ends_a_solid(algebra3d::AsciiCursor word);

  const char* end_;
  // Cache of the last line found and the first word after it: a file may be one line with a million names.
  const char* line_begin_;
  const char* line_end_ = nullptr;
  algebra3d::AsciiCursor next_;
};

}  // namespace mesh_formats
