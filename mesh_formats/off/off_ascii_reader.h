#pragma once

#include <atomic>
#include <string_view>

#include "algebra3d/base/error.h"
#include "mesh_formats/detail/read_mesh.h"
#include "mesh_formats/off/off_header.h"

namespace mesh_formats {

/// Reads an ASCII file after its header; see `read_off` for the common rules.
///
/// - The keyword may be missing: then the file begins with its counts, and vertices have coordinates only. The counts
///   may follow the keyword in its line.
/// - Blanks and line breaks (CR, LF or CRLF) may stand between any two numbers, and comments from `#` to the end of the
///   line; but a vertex and a face each end with their line, since only the end of the line determines how many numbers
///   a colour has. Up to six surplus numbers after a vertex, and up to four after a face, that are no attributes are
///   ignored.
/// - The number of edges may be missing; it is in the line of the number of faces or alone in the next.
/// - Text after the last face, such as NUL bytes, is ignored with a remark.
algebra3d::Result<ReadMesh> read_ascii_off(std::string_view bytes, const OffHeader& header, std::string_view file_name,
                                           Wanted wanted, const std::atomic<bool>* cancel);

}  // namespace mesh_formats
