#pragma once

#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The mesh without pairs of triangles that lie upon each other, front to front or back to back: they have nothing
/// between them. Points that nothing needs are left out, the order of all others is kept. Cost: n log n.
TriangleMesh without_opposite_triangles(const TriangleMesh& mesh);

}  // namespace algebra3d
