#pragma once

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The same triangles, with the faces at each non-manifold edge in pairs that go on from each other: those whose
/// normals are most alike first. A vertex is there once for each fan of faces that are linked in this way, so that all
/// edges are manifold, but for those whose pairs have both vertices in common. Isolated vertices go. Domain: a mesh
/// without boundary, with double coordinates. Deterministic. Cost: linear, and the cube of the number of faces at a
/// non-manifold edge.
TriangleMesh with_paired_faces(const TriangleMesh& mesh);

}  // namespace algebra3d
