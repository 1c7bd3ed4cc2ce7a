#pragma once

#include "algebra3d/arrangement/disjoint_sets.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The faces, in sets that hang together across edges of two faces, whichever way these run along them. Cost: linear.
arrangement::DisjointSets parts_across_simple_edges(const TriangleMesh& mesh);

}  // namespace algebra3d
