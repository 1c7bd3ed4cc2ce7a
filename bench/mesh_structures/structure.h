#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

/// The data structures for triangle meshes that [campagna1998] compares, for closed manifold meshes; the library has
/// only one of them, directed edges that are "small". A structure is made of a TriangleMesh, keeps its numbers of
/// vertices and faces, and has
/// - vertex_count, face_count, and bytes: all that it stores, coordinates as doubles,
/// - visit_ring(v, visit) and visit_faces_round(v, visit): the vertices and the faces round a vertex,
/// - visit_edges(visit): the two faces of each edge,
/// - visit_neighbours(f, visit): the faces along the edges of a face.
namespace bench::structures {

using algebra3d::FaceId;
using algebra3d::HalfedgeId;
using algebra3d::TriangleMesh;
using algebra3d::Vec3;
using algebra3d::VertexId;
using Index = std::uint32_t;

template <typename T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

/// Points, and an edge or half-edge of each.
struct Vertices {
  std::vector<Vec3> points;
  std::vector<Index> edges;

  /// With the half-edges that the mesh gives them.
  explicit Vertices(const TriangleMesh& mesh) : points(mesh.points().approx()) {
    for (Index v = 0; v < mesh.vertex_count(); ++v) edges.push_back(mesh.outgoing(VertexId(v)).index());
  }
  std::size_t size() const { return points.size(); }
};

inline std::size_t bytes_of(const Vertices& vertices) {
  return bytes_of(vertices.points) + bytes_of(vertices.edges);
}

}  // namespace bench::structures
