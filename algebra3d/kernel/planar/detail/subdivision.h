#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/kernel/planar/detail/ids.h"
#include "base/id_vector.h"
#include "base/large_allocator.h"

namespace algebra3d::planar {

/// A planar subdivision as rings of half-edges around the vertices: half-edges 2e and 2e + 1 run along edge e in
/// opposite directions. The face of a half-edge lies to its left. Edges can be added and removed; half-edges have a
/// mark, initially 0. Source: [guibas1985], with the rings of the primal graph only.
class Subdivision {
 public:
  explicit Subdivision(std::size_t vertex_count) : halfedges_of_vertices_(vertex_count) {
    // The maximum number of edges of a planar graph.
    halfedges_.resize(6 * vertex_count);
  }

  static HalfedgeId twin(HalfedgeId h) { return HalfedgeId(h.index() ^ 1U); }
  VertexId origin(HalfedgeId h) const { return halfedges_[h].origin; }
  VertexId target(HalfedgeId h) const { return origin(twin(h)); }
  /// The next half-edges around the origin.
  HalfedgeId ccw(HalfedgeId h) const { return halfedges_[h].ccw; }
  HalfedgeId cw(HalfedgeId h) const { return halfedges_[h].cw; }
  /// The next half-edge around the face to the left.
  HalfedgeId next(HalfedgeId h) const { return cw(twin(h)); }

  std::uint32_t mark(HalfedgeId h) const { return halfedges_[h].mark; }
  void set_mark(HalfedgeId h, std::uint32_t mark) { halfedges_[h].mark = mark; }

  /// Those of edges that were taken out have no origin.
  IdRange<HalfedgeId> halfedges() const { return IdRange<HalfedgeId>(count_); }
  bool is_taken_out(HalfedgeId h) const { return origin(h).is_none(); }
  /// A half-edge that leaves the vertex; kNone if there is none. Requires `link_vertices`.
  HalfedgeId halfedge_of(VertexId vertex) const { return halfedges_of_vertices_[vertex]; }
  void link_vertices();
  /// A half-edge of the unbounded face.
  HalfedgeId outer_halfedge() const { return outer_; }
  void set_outer_halfedge(HalfedgeId h) { outer_ = h; }

  /// Adds an edge that is linked to no other.
  HalfedgeId add(VertexId from, VertexId to);
  /// Adds an edge from the origin of `after` to that of `after_there`, next to both counter-clockwise.
  HalfedgeId add_after(HalfedgeId after, HalfedgeId after_there);
  /// Adds an edge from the target of h to the origin of g, through the face to the left of both.
  HalfedgeId connect(HalfedgeId h, HalfedgeId g) { return add_after(next(h), g); }
  /// Joins two rings to one, or splits one into two.
  void splice(HalfedgeId h, HalfedgeId g);
  void remove(HalfedgeId h);

 private:
  struct HalfEdge {
    VertexId origin;
    HalfedgeId ccw, cw;
    std::uint32_t mark;
  };

  IdVector<HalfedgeId, HalfEdge, LargeAllocator<HalfEdge>> halfedges_;  // used as far as count_
  std::uint32_t count_ = 0;
  std::vector<HalfedgeId> free_;  // the first of each edge that was taken out
  IdVector<VertexId, HalfedgeId> halfedges_of_vertices_;
  HalfedgeId outer_;
};

inline HalfedgeId Subdivision::add(VertexId from, VertexId to) {
  HalfedgeId h(count_);
  if (free_.empty()) {
    count_ += 2;
  } else {
    h = free_.back();
    free_.pop_back();
  }
  halfedges_[h] = {from, h, h, 0};
  halfedges_[twin(h)] = {to, twin(h), twin(h), 0};
  return h;
}

inline void Subdivision::splice(HalfedgeId h, HalfedgeId g) {
  HalfEdge &first = halfedges_[h], &second = halfedges_[g];
  std::swap(first.ccw, second.ccw);
  halfedges_[first.ccw].cw = h;
  halfedges_[second.ccw].cw = g;
}

inline HalfedgeId Subdivision::add_after(HalfedgeId after, HalfedgeId after_there) {
  const HalfedgeId h = add(origin(after), origin(after_there));
  splice(h, after);
  splice(twin(h), after_there);
  return h;
}

inline void Subdivision::remove(HalfedgeId h) {
  for (const HalfedgeId side : {h, twin(h)}) {
    HalfedgeId& at_vertex = halfedges_of_vertices_[origin(side)];
    if (at_vertex == side) at_vertex = ccw(side);
    splice(side, cw(side));
    halfedges_[side].origin = {};
  }
  free_.emplace_back(h.index() & ~1U);
}

}  // namespace algebra3d::planar
