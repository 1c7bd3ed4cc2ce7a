#pragma once

#include <string_view>

#include "algebra3d/base/error.h"
#include "base/byte_sink.h"
#include "base/output_path.h"
#include "base/triangle_soup.h"
#include "stl/stl_content.h"

namespace mesh_formats {

/// Writes the triangles of `soup` as one solid.
///
/// The name becomes one line: control characters become blanks, and blanks at the ends are removed. In a binary file it
/// is the header, cut to 80 bytes between characters; a name that begins with `solid` gets the prefix `STL `, since
/// readers would take the file for ASCII. Attribute bytes are 0. The soup's own name and normals are not used.
/// Exactness: each coordinate is rounded once, to the nearest float; ASCII digits are the shortest for the same double,
/// and so for the same float. Normals are computed from the rounded corners and have length 1; only those of triangles
/// without area are zero, if the differences of the corners are doubles (as for coordinates of similar magnitude;
/// otherwise normals are as exact as these differences). Errors: invalid_value (a coordinate that is not finite or
/// beyond the range of float, with its triangle), limit_exceeded (more than 2^32 - 1 triangles in a binary file), those
/// of the sink. Source: [jeannerod2013], for the normals.
algebra3d::Status write_stl(algebra3d::ByteSink& sink, const algebra3d::TriangleSoup& soup, std::string_view name,
                            Encoding format);

/// `write_stl` to the file at `path`, atomically (AtomicFile).
algebra3d::Status write_stl_file(const algebra3d::OutputPath& path, const algebra3d::TriangleSoup& soup,
                                 std::string_view name, Encoding format);

}  // namespace mesh_formats
