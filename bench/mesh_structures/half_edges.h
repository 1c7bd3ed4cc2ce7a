#pragma once

#include "mesh_structures/structure.h"

namespace bench::structures {

/// The traversal of structures of half-edges or directed edges: `Derived` has outgoing(v), target(h), next(h), prev(h),
/// opposite(h), face(h), halfedge(f) and halfedge_count().
template <typename Derived>
class HalfedgeTraversal {
 public:
  template <typename Visit>
  void visit_ring(Index v, const Visit& visit) const {
    visit_outgoing(v, [&](Index h) { visit(self().target(h)); });
  }
  template <typename Visit>
  void visit_faces_round(Index v, const Visit& visit) const {
    visit_outgoing(v, [&](Index h) { visit(self().face(h)); });
  }
  template <typename Visit>
  void visit_edges(const Visit& visit) const {
    const auto count = static_cast<Index>(self().halfedge_count());
    for (Index h = 0; h < count; ++h)
      if (const Index other = self().opposite(h); h < other) visit(self().face(h), self().face(other));
  }
  template <typename Visit>
  void visit_neighbours(Index f, const Visit& visit) const {
    Index h = self().halfedge(f);
    for (int i = 0; i < 3; ++i, h = self().next(h)) visit(self().face(self().opposite(h)));
  }

 private:
  const Derived& self() const { return static_cast<const Derived&>(*this); }

  template <typename Visit>
  void visit_outgoing(Index v, const Visit& visit) const {
    const Index first = self().outgoing(v);
    Index h = first;
    do {
      visit(h);
      h = self().next(self().opposite(h));  // clockwise, so that no record needs the half-edge before it
    } while (h != first);
  }
};

/// Half-edges with target, opposite, next and face, and a half-edge for each face. Source: [mantyla1988].
class HalfEdges : public HalfedgeTraversal<HalfEdges> {
 public:
  explicit HalfEdges(const TriangleMesh& mesh) : vertices_(mesh) {
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
      const HalfedgeId id(h);
      halfedges_.push_back(
          {mesh.target(id).index(), mesh.opposite(id).index(), mesh.next(id).index(), mesh.face(id).index()});
    }
    for (Index f = 0; f < mesh.face_count(); ++f) faces_.push_back(3 * f);
  }

  std::size_t vertex_count() const { return vertices_.size(); }
  std::size_t face_count() const { return faces_.size(); }
  std::size_t halfedge_count() const { return halfedges_.size(); }
  std::size_t bytes() const { return bytes_of(vertices_) + bytes_of(halfedges_) + bytes_of(faces_); }

  Index outgoing(Index v) const { return vertices_.edges[v]; }
  Index target(Index h) const { return halfedges_[h].target; }
  Index opposite(Index h) const { return halfedges_[h].opposite; }
  Index next(Index h) const { return halfedges_[h].next; }
  Index face(Index h) const { return halfedges_[h].face; }
  Index halfedge(Index f) const { return faces_[f]; }

 private:
  struct Halfedge {
    Index target, opposite, next, face;
  };

  Vertices vertices_;
  std::vector<Halfedge> halfedges_;
  std::vector<Index> faces_;
};

}  // namespace bench::structures
