#pragma once

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// Proves that the mesh is a valid volume (prove_volume) that is star-shaped about `centre`: the centre lies strictly
/// behind the plane of every triangle, so every ray from it meets the boundary once. That holds for convex solids and
/// any inner point, and for others and a point that sees the whole inside. The proof is in the source. False for every
/// other mesh, valid or not, also for the empty one. Exact. Cost: linear, some ten nanoseconds per triangle if all
/// coordinates are doubles. Source: [mehlhorn1999] and [devillers1998], who check convex polytopes this way.
bool is_star_shaped(const TriangleMesh& mesh, const PointRef& centre);

}  // namespace algebra3d
