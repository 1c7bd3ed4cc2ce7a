#pragma once

#include <filesystem>
#include <string_view>

#include "algebra3d/base/error.h"
#include "algebra3d/base/triangle_soup.h"
#include "stl/stl_format.h"

namespace stl {

/// Writes the triangles of `soup` as one solid to the file at `path`, whole or not at all (see AtomicFile).
///
/// The name becomes one line: control characters turn into blanks, and blanks at the ends go. A binary file has its
/// first 80 bytes as the header, cut between characters; since readers take `solid` there for ASCII, a name that begins
/// so has `STL ` put before it. Attribute bytes are 0. The soup's own name and normals are not used.
/// Exactness: each coordinate is rounded once, to the nearest float; ASCII digits are the shortest that give the same
/// value as a double, and so the same float too. Normals are computed from the rounded corners and have length 1; that
/// of a triangle without area is zero, and of no other, as long as the differences of the corners are doubles
/// (coordinates of like magnitude are far from that limit; beyond it a normal is only as good as these differences).
/// Errors: invalid_value (a coordinate that is not finite or beyond the range of float, with its triangle),
/// limit_exceeded (more than 2^32 - 1 triangles in a binary file), disk_full, file_missing (no such folder), io_error.
/// Source: [jeannerod2013], for the normals.
algebra3d::Status write_stl_file(const std::filesystem::path& path, const algebra3d::TriangleSoup& soup,
                                 std::string_view name, Format format);

}  // namespace stl
