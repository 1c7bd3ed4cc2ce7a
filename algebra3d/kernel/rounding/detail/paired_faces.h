#pragma once

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The triangles of a mesh with the faces at each non-manifold edge linked in pairs that go on from each other: those
/// whose normals are most alike first. Each vertex is duplicated once per fan of linked faces, so that all edges are
/// manifold except those whose pairs have both vertices in common. Isolated vertices are removed. Domain: a mesh
/// without boundary, with double coordinates. Deterministic. Cost: linear, and the cube of the number of faces at a
/// non-manifold edge.
TriangleMesh with_paired_faces(const TriangleMesh& mesh);

}  // namespace algebra3d
