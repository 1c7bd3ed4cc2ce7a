#pragma once

#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The faces of a mesh in groups of whole shells, between whose boxes there is a plane parallel to two axes. Largest
/// boxes, by their longest sides, come first. Deterministic. Cost: sorting of the shells for each axis, a few times.
std::vector<std::vector<FaceId>> bodies_apart(const TriangleMesh& mesh);

}  // namespace algebra3d
