#pragma once

#include <atomic>
#include <string_view>

#include "algebra3d/base/error.h"
#include "stl/stl_content.h"

namespace mesh_formats {

/// Reads an ASCII file:
///
///     solid NAME
///       facet normal x y z  outer loop  vertex x y z  vertex x y z  vertex x y z  endloop  endfacet
///       ...
///     endsolid NAME
///
/// - Keywords in any case; blanks and line breaks (CR, LF, CRLF) may be between any two words. A byte order mark,
///   leading white space, and comments from `#` to the end of the line are skipped. `end solid`, `end loop` and `end
///   facet` count as one word. Any number of solids; the soup takes the name of the first.
/// - A name is the rest of its line, with any words, trimmed; it may be missing. It ends earlier only if the file
///   continues in the same line: a solid's name before `facet normal` with three numbers and `outer`, or before an
///   `endsolid` whose line is followed by `solid` or the end of the file; the name after `endsolid` before a `solid`
///   whose first facet or end is in the same line or begins the next.
/// - Tolerated with a remark: a missing `endsolid` (but not at the end of a file without facets); NUL and Ctrl-Z bytes
///   after the last solid; normals that are NaN or infinite, which become zero.
/// - Everything else is an error, also a coordinate that is not finite or beyond the range of double, and a loop of
///   more or fewer than three corners. Numbers too small for a double become zero.
algebra3d::Result<ReadStl> read_ascii(std::string_view bytes, std::string_view file_name,
                                      const std::atomic<bool>* cancel);

}  // namespace mesh_formats
