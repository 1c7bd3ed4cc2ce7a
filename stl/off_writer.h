#pragma once

#include <filesystem>

#include "algebra3d/base/error.h"
#include "algebra3d/base/polygon_soup.h"
#include "stl/stl_format.h"

namespace stl {

/// Writes `soup` to an OFF file at `path`, whole or not at all (see AtomicFile): all points, used or not, and all
/// faces, in their order. The number of edges is given as 0, which the format allows; it has no place for a name. A
/// binary file is as the format has it: big-endian, with 0 colour floats behind each face.
///
/// Exactness: ASCII digits are the shortest that give the same double, so what is written reads back unchanged; binary
/// coordinates are rounded once, to the nearest float.
/// Errors: invalid_value (a soup that breaks its invariants, a face of fewer than 3 corners, in a binary file also a
/// coordinate beyond the range of float, with its place), limit_exceeded (more than 2^31 - 1 points or faces in a
/// binary file), disk_full, file_missing (no such folder), io_error, wrong_usage (the file is a database).
algebra3d::Status write_off_file(const std::filesystem::path& path, const algebra3d::PolygonSoup& soup, Format format);

}  // namespace stl
