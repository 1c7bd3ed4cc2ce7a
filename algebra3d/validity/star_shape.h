#pragma once

#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// Whether the mesh is a valid volume (prove_volume) all of whose triangles turn their backs to `centre`, none of them
/// in a plane with it: then every ray from the centre meets the boundary once, and the solid is star-shaped about it.
/// So convex solids, their facets in as many triangles as one likes, about any inner point; others about a point from
/// which all of the inside is seen. The argument stands in the source. False of every other mesh, valid or not, the
/// empty one too. Exact. Cost: linear, some ten nanoseconds for each triangle if all coordinates are doubles.
/// Source: [mehlhorn1999] and [devillers1998], where convex polytopes are checked so.
bool is_star_shaped(const TriangleMesh& mesh, const PointRef& centre);

}  // namespace algebra3d
