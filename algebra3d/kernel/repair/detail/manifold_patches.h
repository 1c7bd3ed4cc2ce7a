#pragma once

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "base/disjoint_ids.h"

namespace algebra3d {

/// Divides the faces into manifold patches: two faces are in one patch if a path across edges with exactly two faces
/// links them. Unlike for the manifold edges of TriangleMesh, the directions of the two faces along the edge do not
/// count: a patch need not be consistently oriented. (A patch of an arrangement is something else.) Cost: linear.
DisjointIds<FaceId> manifold_patches(const TriangleMesh& mesh);

}  // namespace algebra3d
