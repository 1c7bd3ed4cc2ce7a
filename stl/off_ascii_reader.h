#pragma once

#include <atomic>
#include <string_view>

#include "algebra3d/base/error.h"
#include "stl/off_header.h"
#include "stl/read_mesh.h"

namespace stl {

/// Reads an ASCII file behind its header; see `read_off` for what holds in both forms.
///
/// - The keyword may be missing: then the file begins with its counts, and vertices have coordinates alone. The counts
///   may follow the keyword in its line.
/// - Blanks and line breaks (CR, LF or CRLF) may stand between any two numbers, and comments from `#` to the end of the
///   line; but a vertex and a face each end with their line, since only the end of the line tells how many numbers a
///   colour has. Up to six surplus numbers behind a vertex, colours or not, and up to four behind a face are left out.
/// - The number of edges may be missing: it stands in the line of the number of faces or alone in the next.
/// - Text behind the last face, say NUL bytes, is left out with a remark.
algebra3d::Result<ReadMesh> read_ascii_off(std::string_view bytes, const OffHeader& header, std::string_view file_name,
                                           const std::atomic<bool>* cancel);

}  // namespace stl
