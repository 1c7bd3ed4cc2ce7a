#pragma once

#include "mesh_structures/structure.h"

namespace bench::structures {

/// One record per edge, with both ends, both faces, and before and after it the edges of both. Source: [baumgart1975].
class WingedEdges {
 public:
  explicit WingedEdges(const TriangleMesh& mesh) : vertices_(mesh), faces_(mesh.face_count()) {
    std::vector<Index> edge_of(mesh.halfedge_count());
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
      const Index other = mesh.opposite(HalfedgeId(h)).index();
      edge_of[h] = other < h ? edge_of[other] : static_cast<Index>(edges_.size());
      if (other > h) edges_.emplace_back();
    }
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
      const HalfedgeId halfedge(h);
      const Index previous = edge_of[mesh.prev(halfedge).index()], next = edge_of[mesh.next(halfedge).index()];
      const Index face = mesh.face(halfedge).index();
      Edge& edge = edges_[edge_of[h]];
      faces_[face] = edge_of[h];
      if (h < mesh.opposite(halfedge).index())
        edge.start = mesh.origin(halfedge).index(), edge.end = mesh.target(halfedge).index(),
        edge.left = {face, previous, next};
      else
        edge.right = {face, previous, next};
    }
    for (Index& edge : vertices_.edges) edge = edge_of[edge];
  }

  std::size_t vertex_count() const { return vertices_.size(); }
  std::size_t face_count() const { return faces_.size(); }
  std::size_t bytes() const { return bytes_of(vertices_) + bytes_of(edges_) + bytes_of(faces_); }

  template <typename Visit>
  void visit_ring(Index v, const Visit& visit) const {
    visit_round(v, [&](const Edge& edge, const Side&) { visit(edge.start == v ? edge.end : edge.start); });
  }
  template <typename Visit>
  void visit_faces_round(Index v, const Visit& visit) const {
    visit_round(v, [&](const Edge&, const Side& side) { visit(side.face); });
  }
  template <typename Visit>
  void visit_edges(const Visit& visit) const {
    for (const Edge& edge : edges_) visit(edge.left.face, edge.right.face);
  }
  template <typename Visit>
  void visit_neighbours(Index f, const Visit& visit) const {
    Index e = faces_[f];
    for (int i = 0; i < 3; ++i) {
      const Edge& edge = edges_[e];
      const bool is_left = edge.left.face == f;
      visit(is_left ? edge.right.face : edge.left.face);
      e = is_left ? edge.left.next : edge.right.next;
    }
  }

 private:
  struct Side {
    Index face, previous, next;
  };
  struct Edge {
    Index start, end;
    Side left, right;
  };

  /// The edges round a vertex, each with the face to the left of it as it leaves the vertex.
  template <typename Visit>
  void visit_round(Index v, const Visit& visit) const {
    const Index first = vertices_.edges[v];
    Index e = first;
    do {
      const Edge& edge = edges_[e];
      const Side& side = edge.start == v ? edge.left : edge.right;
      visit(edge, side);
      e = side.previous;
    } while (e != first);
  }

  Vertices vertices_;
  std::vector<Edge> edges_;
  std::vector<Index> faces_;  // an edge of each
};

}  // namespace bench::structures
