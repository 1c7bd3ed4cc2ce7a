#pragma once

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/validity/detail/triangles.h"
#include "algebra3d/kernel/validity/face_set.h"
#include "algebra3d/kernel/validity/report.h"

namespace algebra3d {

/// Checks the edges of a volume: adds boundary, inconsistent and non-manifold edges to `report`. An edge is valid if it
/// is balanced and the directions of its triangles alternate around it: then the sectors around the edge are
/// alternately in front of and behind the triangles. Edges of degenerate triangles, or with two triangles in the same
/// half-plane (which overlap, as the search for intersections finds), are only checked for balance. Edges with faces in
/// `excepted` only are not checked. Exact. Cost: linear; n log n for an edge of n triangles.
void check_edges(const TriangleMesh& mesh, const SoundFaces& sound, ValidityReport& report,
                 const FaceSet& excepted = {});

}  // namespace algebra3d
