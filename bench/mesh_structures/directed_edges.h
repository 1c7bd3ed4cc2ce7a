#pragma once

#include "mesh_structures/half_edges.h"

namespace bench::structures {

// Records of directed edges; 3f, 3f + 1 and 3f + 2 are those of face f. Missing members of a record are computed from
// the others, or from the number. `kHasStart` if the record stores where the edge starts, and not only its end.

struct FullEdge {
  static constexpr bool kHasStart = true;
  Index start, end, previous, following, neighbour;

  static FullEdge of(const TriangleMesh& mesh, HalfedgeId h) {
    return {mesh.origin(h).index(), mesh.target(h).index(), mesh.prev(h).index(), mesh.next(h).index(),
            mesh.opposite(h).index()};
  }
  Index next(Index /*h*/, const std::vector<FullEdge>& /*edges*/) const { return following; }
  Index prev(Index /*h*/, const std::vector<FullEdge>& /*edges*/) const { return previous; }
};

struct MediumEdge {
  static constexpr bool kHasStart = false;
  Index end, previous, neighbour;

  static MediumEdge of(const TriangleMesh& mesh, HalfedgeId h) {
    return {mesh.target(h).index(), mesh.prev(h).index(), mesh.opposite(h).index()};
  }
  Index next(Index /*h*/, const std::vector<MediumEdge>& edges) const { return edges[previous].previous; }
  Index prev(Index /*h*/, const std::vector<MediumEdge>& /*edges*/) const { return previous; }
};

struct SmallEdge {
  static constexpr bool kHasStart = false;
  Index end, neighbour;

  static SmallEdge of(const TriangleMesh& mesh, HalfedgeId h) {
    return {mesh.target(h).index(), mesh.opposite(h).index()};
  }
  Index next(Index h, const std::vector<SmallEdge>& /*edges*/) const { return h % 3 == 2 ? h - 2 : h + 1; }
  Index prev(Index h, const std::vector<SmallEdge>& /*edges*/) const { return h % 3 == 0 ? h + 2 : h - 1; }
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
  Index prev(Index h) const { return edges_[h].prev(h, edges_); }
  Index face(Index h) const { return h / 3; }
  Index halfedge(Index f) const { return 3 * f; }
  const Vec3& point(Index v) const { return vertices_.points[v]; }

  /// Moves the start of h, and so the end of the edge before it, to vertex v.
  void set_origin(Index h, Index v) {
    edges_[prev(h)].end = v;
    if constexpr (Edge::kHasStart) edges_[h].start = v;
  }
  void set_outgoing(Index v, Index h) { vertices_.edges[v] = h; }
  void link(Index h, Index other) {
    edges_[h].neighbour = other;
    edges_[other].neighbour = h;
  }

 private:
  Vertices vertices_;
  std::vector<Edge> edges_;
};

}  // namespace bench::structures
