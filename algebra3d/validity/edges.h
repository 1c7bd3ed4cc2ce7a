#pragma once

#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/validity/report.h"
#include "algebra3d/validity/triangles.h"

namespace algebra3d {

/// What a volume demands of its edges: adds boundary, inconsistent and non-manifold edges to `report`. An edge passes
/// if as many triangles run along it one way as the other, and, going round it, the ways alternate: then the sectors
/// round the edge are in turn in front of and behind the triangles that bound them. Edges of degenerate triangles have
/// no such order, and where two triangles span the same half-plane they overlap, which the search for intersections
/// finds: these are judged by their numbers alone. Exact. Cost: linear; n log n round an edge of n triangles.
void check_edges(const TriangleMesh& mesh, const SoundFaces& sound, ValidityReport& report);

}  // namespace algebra3d
