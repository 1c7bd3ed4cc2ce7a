#pragma once

#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/detail/moved_points.h"

namespace algebra3d {

/// New places for vertices of a valid volume, so that facets which are nearly parallel, in either orientation, and
/// closer to each other than `reach` (in coordinate units) become coplanar exactly: vertices of the smaller facet move
/// into the plane of the larger one. Only facets with a vertex in question are looked at. `in_question`: per vertex,
/// whether a triangle at it crossed others after rounding (its pixel was widened). No vertex moves farther than 4 *
/// reach; none moves if there is nothing to snap. Exact, but for the choice of close facets. Errors: none. Cost: n log
/// n, and some microseconds per vertex of a pair of such facets.
MovedVertices snap_coplanar(const TriangleMesh& solid, const std::vector<bool>& in_question, double reach);

}  // namespace algebra3d
