#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/planar/plane_points.h"
#include "rtree/large_allocator.h"

namespace algebra3d::planar {

/// A planar subdivision as rings of half-edges round the vertices: half-edges 2e and 2e + 1 run along edge e in
/// opposite directions. The face of a half-edge lies to its left. Edges may be taken out and added, and half-edges
/// carry a mark, 0 at first. Source: [guibas1985], with the rings of the primal graph alone.
class Subdivision {
 public:
  explicit Subdivision(std::uint32_t vertex_count) : halfedges_of_vertices_(vertex_count, kNone) {
    // A planar graph has no more edges at any time.
    halfedges_.resize(std::size_t{6} * vertex_count);
  }

  static std::uint32_t twin(std::uint32_t h) { return h ^ 1U; }
  std::uint32_t origin(std::uint32_t h) const { return halfedges_[h].origin; }
  std::uint32_t target(std::uint32_t h) const { return origin(twin(h)); }
  /// The next half-edges round the origin.
  std::uint32_t ccw(std::uint32_t h) const { return halfedges_[h].ccw; }
  std::uint32_t cw(std::uint32_t h) const { return halfedges_[h].cw; }
  /// The next half-edge round the face to the left.
  std::uint32_t next(std::uint32_t h) const { return cw(twin(h)); }

  std::uint32_t mark(std::uint32_t h) const { return halfedges_[h].mark; }
  void set_mark(std::uint32_t h, std::uint32_t mark) { halfedges_[h].mark = mark; }

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(halfedges_of_vertices_.size()); }
  /// Those of edges that were taken out have the origin kNone.
  std::uint32_t halfedge_count() const { return count_; }
  /// Some half-edge that leaves the vertex, once `link_vertices` was called; kNone if there is none.
  std::uint32_t halfedge_of(std::uint32_t vertex) const { return halfedges_of_vertices_[vertex]; }
  void link_vertices();
  /// A half-edge whose face is the unbounded one.
  std::uint32_t outer_halfedge() const { return outer_; }
  void set_outer_halfedge(std::uint32_t h) { outer_ = h; }

  /// An edge that is linked to no other.
  std::uint32_t add(std::uint32_t from, std::uint32_t to);
  /// An edge from the vertex of ring `after` to that of `after_there`, next to them counter-clockwise.
  std::uint32_t add_after(std::uint32_t after, std::uint32_t after_there);
  /// An edge from the target of h to the origin of g, through the face to the left of both.
  std::uint32_t connect(std::uint32_t h, std::uint32_t g) { return add_after(next(h), g); }
  /// Two rings become one, or one two.
  void splice(std::uint32_t h, std::uint32_t g);
  void remove(std::uint32_t h);

 private:
  struct HalfEdge {
    std::uint32_t origin, ccw, cw, mark;
  };

  std::vector<HalfEdge, rtree::LargeAllocator<HalfEdge>> halfedges_;  // used as far as count_
  std::uint32_t count_ = 0;
  std::vector<std::uint32_t> free_;
  std::vector<std::uint32_t> halfedges_of_vertices_;
  std::uint32_t outer_ = kNone;
};

inline std::uint32_t Subdivision::add(std::uint32_t from, std::uint32_t to) {
  std::uint32_t h = count_;
  if (free_.empty()) {
    count_ += 2;
  } else {
    h = free_.back();
    free_.pop_back();
  }
  halfedges_[h] = {from, h, h, 0};
  halfedges_[h + 1] = {to, h + 1, h + 1, 0};
  return h;
}

inline void Subdivision::splice(std::uint32_t h, std::uint32_t g) {
  HalfEdge &first = halfedges_[h], &second = halfedges_[g];
  std::swap(first.ccw, second.ccw);
  halfedges_[first.ccw].cw = h;
  halfedges_[second.ccw].cw = g;
}

inline std::uint32_t Subdivision::add_after(std::uint32_t after, std::uint32_t after_there) {
  const std::uint32_t h = add(origin(after), origin(after_there));
  splice(h, after);
  splice(twin(h), after_there);
  return h;
}

inline void Subdivision::remove(std::uint32_t h) {
  for (const std::uint32_t side : {h, twin(h)}) {
    std::uint32_t& at_vertex = halfedges_of_vertices_[origin(side)];
    if (at_vertex == side) at_vertex = ccw(side);
    splice(side, cw(side));
    halfedges_[side].origin = kNone;
  }
  free_.push_back(h & ~1U);
}

}  // namespace algebra3d::planar
