#pragma once

#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// A mesh without some of its faces, and with those of `added` in their place: the faces that stay in their order, then
/// the new ones. Vertices at the same place become one, vertices that only removed faces had are left out. Known planes
/// are dropped. `is_removed`: one flag per face of `mesh`. The links of faces that stay are reused. Cost: linear, some
/// 50 ns per face.
TriangleMesh with_replaced_faces(const TriangleMesh& mesh, const std::vector<bool>& is_removed,
                                 const TriangleMesh& added);

}  // namespace algebra3d
