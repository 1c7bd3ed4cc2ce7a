#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/halfedge/boundary_loop.h"
#include "algebra3d/halfedge/face_components.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// Finds connected components: faces are connected across common edges, manifold or not, but not by common
/// vertices. Cost: linear.
template <typename Layout>
FaceComponents connected_components(const HalfedgeMesh<Layout>& mesh);

/// All boundary loops; each boundary half-edge is in one. At a non-manifold vertex a loop stays on its fan, so
/// faces that touch in a point have separate loops. Closed loops start at their lowest half-edge; loops are ordered
/// by first half-edge. Cost: linear.
template <typename Layout>
std::vector<BoundaryLoop> boundary_loops(const HalfedgeMesh<Layout>& mesh);

/// Number of undirected edges: manifold, boundary and non-manifold ones. Cost: linear.
template <typename Layout>
std::size_t edge_count(const HalfedgeMesh<Layout>& mesh);
/// Vertices minus edges plus faces, without isolated vertices. Cost: linear.
template <typename Layout>
std::int64_t euler_characteristic(const HalfedgeMesh<Layout>& mesh);

/// True if no edge is boundary (non-manifold edges are not boundary). The empty mesh is closed.
template <typename Layout>
bool is_closed(const HalfedgeMesh<Layout>& mesh);
/// True if no edge and no vertex is non-manifold; then the surface is also consistently oriented, since the half-edges
/// of a manifold edge run in opposite directions.
template <typename Layout>
bool is_manifold(const HalfedgeMesh<Layout>& mesh);
/// True if equally many of the half-edges of an edge run in each direction.
template <typename Layout>
bool is_balanced(const HalfedgeMesh<Layout>& mesh, std::span<const HalfedgeId> edge);
/// In which order the faces at an edge run along it in one direction and the other, from half-plane to half-plane.
enum class EdgeOrder : std::uint8_t {
  alternating,  ///< the directions alternate, as at an edge of a solid, where sectors are in turn in front of faces and
                ///< behind them
  overlapping,  ///< some faces lie in one half-plane
  mixed,        ///< none do, and neighbours run in the same direction
};
/// The order of the faces at a balanced edge, none of which may be degenerate. Exact. Cost: n log n for n faces.
EdgeOrder order_around(const TriangleMesh& mesh, std::span<const HalfedgeId> edge);
/// True if every edge that is not boundary is balanced. Half-edges from a vertex to itself do not count.
template <typename Layout>
bool is_consistently_oriented(const HalfedgeMesh<Layout>& mesh);

/// Number of handles of a closed manifold mesh, summed over its components; 0 for the empty mesh. Undefined, with the
/// reason, if the mesh has boundary edges or non-manifold edges or vertices. Cost: linear.
template <typename Layout>
Maybe<std::int64_t> genus(const HalfedgeMesh<Layout>& mesh);
/// The genus of each component, also of components that touch each other in vertices.
template <typename Layout>
std::vector<Maybe<std::int64_t>> component_genus(const HalfedgeMesh<Layout>& mesh, const FaceComponents& components);

/// The mesh with all triangles flipped: second and third corner are swapped. Cost: linear.
TriangleMesh flipped(const TriangleMesh& mesh);
/// The mesh of the given faces in the given order. Vertices are renumbered by first use; none is isolated. Faces may
/// repeat. Cost: linear.
TriangleMesh submesh(const TriangleMesh& mesh, std::span<const FaceId> faces);

/// Makes many submeshes of one mesh, to which it refers. Cost: linear in the mesh once, then linear in the faces of
/// each submesh.
class SubmeshMaker {
 public:
  explicit SubmeshMaker(const TriangleMesh& mesh);
  TriangleMesh make(std::span<const FaceId> faces);

 private:
  FacePlanes planes_of(std::span<const FaceId> faces);

  const TriangleMesh& mesh_;
  // New numbers of vertices and planes, unset between calls.
  std::vector<std::uint32_t> vertices_, planes_;
};

}  // namespace algebra3d
