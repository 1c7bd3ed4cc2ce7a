#pragma once

#include "mesh_structures/half_edges.h"

namespace bench::structures {

// Records of directed edges; 3f, 3f + 1 and 3f + 2 are those of face f. Missing members of a record are computed from
// the others, or from the number.

struct FullEdge {
  Index start, end, previous, following, neighbour;

  static FullEdge of(const TriangleMesh& mesh, HalfedgeId h) {
    return {mesh.origin(h).index(), mesh.target(h).index(), mesh.prev(h).index(), mesh.next(h).index(),
            mesh.opposite(h).index()};
  }
  Index next(Index /*h*/, const std::vector<FullEdge>& /*edges*/) const { return following; }
};

struct MediumEdge {
  Index end, previous, neighbour;

  static MediumEdge of(const TriangleMesh& mesh, HalfedgeId h) {
    return {mesh.target(h).index(), mesh.prev(h).index(), mesh.opposite(h).index()};
  }
  Index next(Index /*h*/, const std::vector<MediumEdge>& edges) const { return edges[previous].previous; }
};

struct SmallEdge {
  Index end, neighbour;

  static SmallEdge of(const TriangleMesh& mesh, HalfedgeId h) {
    return {mesh.target(h).index(), mesh.opposite(h).index()};
  }
  Index next(Index h, const std::vector<SmallEdge>& /*edges*/) const { return h % 3 == 2 ? h - 2 : h + 1; }
};

/// Directed edges in an array of records. Source: [campagna1998].
template <typename Edge>
class DirectedEdges : public HalfedgeTraversal<DirectedEdges<Edge>> {
 public:
  explicit DirectedEdges(const TriangleMesh& mesh) : vertices_(mesh) {
    for (Index h = 0; h < mesh.halfedge_count(); ++h) edges_.push_back(Edge::of(mesh, HalfedgeId(h)));
  }

  std::size_t vertex_count() const { return vertices_.size(); }
  std::size_t face_count() const { return edges_.size() / 3; }
  std::size_t halfedge_count() const { return edges_.size(); }
  std::size_t bytes() const { return bytes_of(vertices_) + bytes_of(edges_); }

  Index outgoing(Index v) const { return vertices_.edges[v]; }
  Index target(Index h) const { return edges_[h].end; }
  Index opposite(Index h) const { return edges_[h].neighbour; }
  Index next(Index h) const { return edges_[h].next(h, edges_); }
  Index face(Index h) const { return h / 3; }
  Index halfedge(Index f) const { return 3 * f; }

 private:
  Vertices vertices_;
  std::vector<Edge> edges_;
};

}  // namespace bench::structures
