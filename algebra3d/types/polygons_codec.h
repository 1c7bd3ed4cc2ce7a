#pragma once

#include "algebra3d/planar/polygons.h"
#include "algebra3d/types/binary_io.h"

namespace algebra3d {

// docs/file_format.md, "Polygons": the corners, and how many each cycle and each face has.

void write_polygons(ByteWriter& writer, const Polygons& polygons);
/// Cycles of three corners at least and faces of one cycle at least, in the plane; what is none of that the reader
/// knows as a failure.
Polygons read_polygons(ByteReader& reader);

/// True if z is 0 everywhere.
bool is_in_plane(const PointArray& points);

}  // namespace algebra3d
