#pragma once

#include "algebra3d/kernel/planar/polygons.h"
#include "algebra3d/values/types/binary_io.h"

namespace algebra3d {

// Writes polygons: the corners, and the sizes of cycles and faces (docs/file_format.md, "Polygons").

void write_polygons(ByteWriter& writer, const Polygons& polygons);
/// Reads polygons in the plane. The reader records a failure for cycles of fewer than three corners and faces without a
/// cycle.
Polygons read_polygons(ByteReader& reader);

/// True if z is 0 everywhere.
bool is_in_plane(const PointArray& points);

}  // namespace algebra3d
