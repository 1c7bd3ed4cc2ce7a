#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/kernel/halfedge/face_planes.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "base/indices.h"

namespace algebra3d {

/// Builds a mesh most of whose triangles are faces of another mesh, and reuses its links. `was`: per triangle the face
/// of `before` with the same corners in the same order, or kNone. Vertices may be renumbered one to one. The result
/// is the same as without `before`. Cost: a few passes, and linking new triangles and those that lost a neighbour.
TriangleMesh relinked(const TriangleMesh& before, std::vector<std::uint32_t> was, PointArray points,
                      std::span<const TriangleMesh::Triangle> triangles, FacePlanes planes = {});

}  // namespace algebra3d
