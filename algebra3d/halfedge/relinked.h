#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/halfedge/face_planes.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// In place of a face: there was none.
inline constexpr std::uint32_t kNewFace = 0xFFFFFFFF;

/// A mesh of triangles most of which are faces of another mesh, whose links are taken over. `was` says which: per
/// triangle the face with the same corners in the same order, or kNewFace. Vertices may have other numbers, but equal
/// ones stand for equal ones.
/// The same mesh as without `before`. Cost: a few passes, and linking what is new or has lost a neighbour.
TriangleMesh relinked(const TriangleMesh& before, std::vector<std::uint32_t> was, PointArray points,
                      std::span<const TriangleMesh::Triangle> triangles, FacePlanes planes = {});

}  // namespace algebra3d
