#pragma once

#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/types/binary_io.h"

namespace algebra3d {

/// The body of a triangle mesh: points in their order, triangles in their order with their corners in order, nothing of
/// the adjacency (docs/file_format.md, "Triangles"). What is read is the same mesh, index by index. Not compressed: the
/// codec does that for every body, and this form is made for it.
/// Cost: n log n for writing (sorted coordinates), linear for reading.
void write_mesh(ByteWriter& writer, const TriangleMesh& mesh);

/// Reads what `write_mesh` wrote, and rebuilds the adjacency. Nothing is proved: any triangles over any points pass,
/// if every index is a point's. On failure (reader.ok() is false) the mesh is empty.
TriangleMesh read_mesh(ByteReader& reader);

}  // namespace algebra3d
