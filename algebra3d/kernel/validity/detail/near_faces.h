#pragma once

#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The faces of a mesh, without the excepted ones, that may be within `reach` of a face of another mesh: all whose
/// boxes are, and others beside them. Ascending. `is_excepted`: one flag per face. Cost: linear in both meshes, some 10
/// ns per face.
std::vector<FaceId> faces_near(const TriangleMesh& mesh, const std::vector<bool>& is_excepted,
                               const TriangleMesh& others, double reach);

}  // namespace algebra3d
