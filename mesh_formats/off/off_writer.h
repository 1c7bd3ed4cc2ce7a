#pragma once

#include "algebra3d/base/error.h"
#include "base/byte_sink.h"
#include "base/mesh_content.h"
#include "base/output_path.h"
#include "base/polygon_soup.h"

namespace mesh_formats {

/// Writes `soup` as an OFF file: all points, also unused ones, and all faces, in
/// order. The number of edges is written as 0, which the format allows; it has no names. Binary files are big-endian.
/// Attributes of points and colours of faces are written, with the keyword that announces them, as `CNOFF`; colours as
/// four numbers from 0 to 1, of faces without an opacity as three. Where a point has no normal, texture coordinate or
/// colour, zeros stand; a face without a colour has none.
///
/// Exactness: ASCII digits are the shortest for the same double, so coordinates read back unchanged; binary coordinates
/// are rounded once, to the nearest float. Errors: invalid_value (a soup that breaks its invariants, a face of fewer
/// than 3 corners, in a binary file also a coordinate beyond the range of float, with its place), limit_exceeded (more
/// than 2^31 - 1 points or faces in a binary file), those of the sink; nothing is written after the first two.
algebra3d::Status write_off(algebra3d::ByteSink& sink, const algebra3d::PolygonSoup& soup, Encoding format);

/// `write_off` to the file at `path`, atomically (AtomicFile).
algebra3d::Status write_off_file(const algebra3d::OutputPath& path, const algebra3d::PolygonSoup& soup,
                                 Encoding format);

}  // namespace mesh_formats
