#pragma once

#include "algebra3d/kernel/halfedge/circulators.h"
#include "mesh_structures/structure.h"

namespace bench::structures {

/// The mesh of the library, through its ranges: directed edges with origin and neighbour in two arrays, for any
/// triangles.
class LibraryMesh {
 public:
  explicit LibraryMesh(const TriangleMesh& mesh) : mesh_(mesh) {}

  std::size_t vertex_count() const { return mesh_.vertex_count(); }
  std::size_t face_count() const { return mesh_.face_count(); }
  std::size_t bytes() const { return mesh_.heap_bytes(); }

  template <typename Visit>
  void visit_ring(Index v, const Visit& visit) const {
    for (const VertexId neighbour : adjacent_vertices(mesh_, VertexId(v))) visit(neighbour.index());
  }
  template <typename Visit>
  void visit_faces_round(Index v, const Visit& visit) const {
    for (const FaceId face : faces_around(mesh_, VertexId(v))) visit(face.index());
  }
  template <typename Visit>
  void visit_edges(const Visit& visit) const {
    for (const HalfedgeId h : edges(mesh_)) visit(mesh_.face(h).index(), mesh_.face(mesh_.opposite(h)).index());
  }
  template <typename Visit>
  void visit_neighbours(Index f, const Visit& visit) const {
    for (const FaceId neighbour : adjacent_faces(mesh_, FaceId(f))) visit(neighbour.index());
  }

 private:
  const TriangleMesh& mesh_;
};

}  // namespace bench::structures
