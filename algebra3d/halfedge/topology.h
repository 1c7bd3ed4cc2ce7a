#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// Connected components of the faces, numbered in order of their first face.
struct FaceComponents {
  std::vector<std::uint32_t> of_face;  ///< component of each face
  std::size_t count = 0;

  /// The faces of each component, ascending.
  std::vector<std::vector<FaceId>> faces() const;
};

/// Two triangles are connected if they share an edge, be it manifold or not; a common vertex does not connect.
/// Cost: linear.
FaceComponents connected_components(const TriangleMesh& mesh);

/// A maximal run of boundary half-edges, each starting where the one before it ends, their faces to the left.
struct BoundaryLoop {
  std::vector<HalfedgeId> halfedges;
  /// False for a run that ends on non-manifold edges, as round the pages of an open book.
  bool is_closed = true;
};

/// All boundary half-edges, each in one loop. At a non-manifold vertex a loop stays on its fan, so that triangles that
/// touch in a point have loops of their own. Closed loops start at their lowest half-edge; loops are ordered by first
/// half-edge. Cost: linear.
std::vector<BoundaryLoop> boundary_loops(const TriangleMesh& mesh);

/// Undirected edges: manifold, boundary and non-manifold ones, each counted once. Cost: linear.
std::size_t edge_count(const TriangleMesh& mesh);
/// Vertices minus edges plus faces. Isolated vertices do not count: they are no part of the surface. Cost: linear.
std::int64_t euler_characteristic(const TriangleMesh& mesh);

/// True if no edge is boundary (non-manifold edges are not boundary). The empty mesh is closed.
bool is_closed(const TriangleMesh& mesh);
/// True if no edge and no vertex is non-manifold; then the surface is also consistently oriented, since the half-edges
/// of a manifold edge run in opposite directions.
bool is_manifold(const TriangleMesh& mesh);
/// True if of the half-edges along one edge as many run one way as the other.
bool is_balanced(const TriangleMesh& mesh, std::span<const HalfedgeId> edge);
/// True if along every edge that is not boundary as many half-edges run one way as the other. Half-edges from a vertex
/// to itself do not count.
bool is_consistently_oriented(const TriangleMesh& mesh);

/// Number of handles of a closed manifold mesh: for several components the sum. The empty mesh has genus 0.
/// Undefined with the reason if the mesh has boundary or non-manifold edges or non-manifold vertices. Cost: linear.
Maybe<std::int64_t> genus(const TriangleMesh& mesh);
/// The same for each component by itself: components that touch each other in vertices still have a genus each.
std::vector<Maybe<std::int64_t>> component_genus(const TriangleMesh& mesh, const FaceComponents& components);

/// The mesh with second and third corner of every triangle swapped: all normals reversed. Cost: linear.
TriangleMesh flipped(const TriangleMesh& mesh);
/// The given faces in the given order, vertices renumbered in order of first use; none is isolated. A face that is
/// given twice appears twice. Cost: linear.
TriangleMesh submesh(const TriangleMesh& mesh, std::span<const FaceId> faces);

/// Makes many submeshes of one mesh, to which it refers, one after the other. Cost: linear in the mesh to begin with,
/// then of each in its faces alone.
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
