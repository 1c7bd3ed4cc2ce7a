#pragma once

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/values/types/binary_io.h"

namespace algebra3d {

/// Writes the body of a triangle mesh: points, triangles and their corners in order, without adjacency
/// (docs/file_format.md, "Triangles"). Reading restores all indices. Not compressed here: the codec compresses every
/// body, and this form suits it. Cost: n log n for writing (sorted coordinates), linear for reading.
void write_mesh(ByteWriter& writer, const TriangleMesh& mesh);

/// Reads the form of `write_mesh` and rebuilds the adjacency. Checks only that indices are valid. On failure
/// (reader.ok() is false) the mesh is empty.
TriangleMesh read_mesh(ByteReader& reader);

}  // namespace algebra3d
