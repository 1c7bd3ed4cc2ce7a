#pragma once

#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The mesh without pairs of triangles with the same corners and opposite orientations, which enclose nothing. Unused
/// vertices are dropped; the others keep their order. Cost: n log n.
TriangleMesh without_opposite_triangles(const TriangleMesh& mesh);

}  // namespace algebra3d
