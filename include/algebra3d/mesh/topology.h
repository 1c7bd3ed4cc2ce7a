#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/halfedge/boundary_loop.h"
#include "algebra3d/halfedge/face_components.h"
#include "algebra3d/mesh/mesh.h"

namespace algebra3d::mesh {

using algebra3d::BoundaryLoop;
using algebra3d::FaceComponents;

// Facts about the connections of a mesh, whatever its shape. Cost: linear.

/// All boundary loops; each boundary half-edge is in one. At a non-manifold vertex a loop stays on its fan. Closed
/// loops start at their lowest half-edge; loops are ordered by first half-edge.
template <AnyMesh M>
std::vector<BoundaryLoop> boundary_loops(const M& mesh);
/// Connected components: faces are connected across common edges, manifold or not, but not by common vertices.
template <AnyMesh M>
FaceComponents connected_components(const M& mesh);
/// True if no edge is boundary (non-manifold edges are not boundary). The empty mesh is closed.
template <AnyMesh M>
bool is_closed(const M& mesh);
/// True if no edge and no vertex is non-manifold; then the surface is also consistently oriented. Cost: constant.
template <AnyMesh M>
bool is_manifold(const M& mesh) {
  return mesh.is_manifold();
}
/// True if along every edge that is not boundary equally many half-edges run in each direction.
template <AnyMesh M>
bool is_consistently_oriented(const M& mesh);
/// Vertices minus edges plus faces, without isolated vertices.
template <AnyMesh M>
std::int64_t euler_characteristic(const M& mesh);
/// Number of handles of a closed manifold mesh, summed over its components. Errors: invalid_value, with the reason, if
/// it is not one.
template <AnyMesh M>
Result<std::int64_t> genus(const M& mesh);

}  // namespace algebra3d::mesh
