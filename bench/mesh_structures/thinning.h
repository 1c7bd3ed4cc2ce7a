#pragma once

#include <algorithm>
#include <cstddef>
#include <queue>
#include <vector>

#include "algebra3d/kernel/simplification/detail/quadric.h"
#include "mesh_structures/directed_edges.h"

namespace bench::structures {

/// Thins a closed mesh, the measurement of [campagna1998]: the vertex whose best collapse along an edge costs least is
/// merged into the other end, again and again. Costs are quadrics [garland1997] of the planes of the first mesh.
/// Collapses that would fold a face or change the topology are left out. Faces that are removed stay as records that
/// nothing links to.
template <typename Edge>
class Thinning {
 public:
  explicit Thinning(DirectedEdges<Edge> edges)
      : edges_(std::move(edges)),
        quadrics_(edges_.vertex_count()),
        versions_(edges_.vertex_count()),
        is_removed_(edges_.vertex_count()),
        face_count_(edges_.face_count()) {
    for (Index f = 0; f < edges_.face_count(); ++f) add_plane_of(f);
    for (Index v = 0; v < edges_.vertex_count(); ++v) enqueue(v);
  }

  std::size_t face_count() const { return face_count_; }

  /// Until at most so many faces are left, or no collapse is possible.
  void thin(std::size_t wanted) {
    while (face_count_ > wanted && !queue_.empty()) {
      const Candidate best = queue_.top();
      queue_.pop();
      if (best.version != versions_[best.vertex] || is_removed_[best.vertex]) continue;
      // Faces round the other end may have changed.
      if (is_allowed(best.vertex, best.halfedge))
        collapse(best.vertex, best.halfedge);
      else
        enqueue(best.vertex);
    }
  }

  /// A number that depends on all corners of the faces that are left, and on their order.
  std::size_t checksum() const {
    std::size_t sum = 0;
    for (Index v = 0; v < edges_.vertex_count(); ++v)
      if (!is_removed_[v]) edges_.visit_ring(v, [&](Index neighbour) { sum = sum * 31 + neighbour; });
    return sum;
  }

 private:
  struct Candidate {
    double cost;
    Index vertex, halfedge;
    std::uint32_t version;
    bool operator<(const Candidate& other) const {
      return cost != other.cost ? cost > other.cost : vertex > other.vertex;
    }
  };

  /// Calls visit(h) for the half-edges that leave v, clockwise.
  template <typename Visit>
  void visit_outgoing(Index v, const Visit& visit) const {
    const Index first = edges_.outgoing(v);
    Index h = first;
    do {
      visit(h);
      h = edges_.next(edges_.opposite(h));
    } while (h != first);
  }

  void add_plane_of(Index f) {
    const Index h = edges_.halfedge(f), next = edges_.next(h);
    const Vec3& a = edges_.point(edges_.target(h));
    const Vec3& b = edges_.point(edges_.target(next));
    const Vec3& c = edges_.point(edges_.target(edges_.next(next)));
    const Vec3 normal = cross(b - a, c - a);
    const double size = algebra3d::length(normal);
    if (size == 0) return;
    algebra3d::Quadric quadric;
    quadric.add_plane((1 / size) * normal, -dot(normal, a) / size, size);
    for (const Index corner : {h, next, edges_.next(next)}) quadrics_[edges_.target(corner)] += quadric;
  }

  /// The best collapse of v, if there is one.
  void enqueue(Index v) {
    Candidate best{0, v, algebra3d::kNone, ++versions_[v]};
    visit_outgoing(v, [&](Index h) {
      const Index to = edges_.target(h);
      const double cost = quadrics_[v].at(edges_.point(to)) + quadrics_[to].at(edges_.point(to));
      if (best.halfedge != algebra3d::kNone && cost >= best.cost) return;
      if (!is_allowed(v, h)) return;
      best.cost = cost;
      best.halfedge = h;
    });
    if (best.halfedge != algebra3d::kNone) queue_.push(best);
  }

  bool is_allowed(Index v, Index h) const { return has_two_common_neighbours(v, edges_.target(h)) && !folds(v, h); }

  bool has_two_common_neighbours(Index v, Index to) const {
    neighbours_.clear();
    edges_.visit_ring(to, [&](Index neighbour) { neighbours_.push_back(neighbour); });
    std::size_t common = 0, valence = 0;
    edges_.visit_ring(v, [&](Index neighbour) {
      ++valence;
      common += std::ranges::count(neighbours_, neighbour);
    });
    return common == 2 && (valence > 3 || neighbours_.size() > 3);
  }

  /// True if a face at v that stays would turn by more than a right angle.
  bool folds(Index v, Index h) const {
    const Vec3 &from = edges_.point(v), &to = edges_.point(edges_.target(h));
    const Index gone = edges_.face(h), also_gone = edges_.face(edges_.opposite(h));
    bool is_folded = false;
    visit_outgoing(v, [&](Index other) {
      const Index f = edges_.face(other);
      if (is_folded || f == gone || f == also_gone) return;
      const Vec3 &b = edges_.point(edges_.target(other)), &c = edges_.point(edges_.target(edges_.next(other)));
      is_folded = dot(cross(b - from, c - from), cross(b - to, c - to)) <= 0;
    });
    return is_folded;
  }

  void collapse(Index v, Index h) {
    const Index to = edges_.target(h), o = edges_.opposite(h);
    // The half-edges on the outer sides of the two faces that vanish.
    const Index above = edges_.opposite(edges_.next(h)), above_at_v = edges_.opposite(edges_.prev(h));
    const Index below = edges_.opposite(edges_.prev(o)), below_at_v = edges_.opposite(edges_.next(o));
    const Index top = edges_.target(edges_.next(h)), bottom = edges_.target(edges_.next(o));
    moved_.clear();
    visit_outgoing(v, [&](Index other) {
      if (other != h && edges_.face(other) != edges_.face(o)) moved_.push_back(other);
    });
    for (const Index other : moved_) edges_.set_origin(other, to);
    edges_.link(above, above_at_v);
    edges_.link(below, below_at_v);
    edges_.set_outgoing(to, above_at_v);
    edges_.set_outgoing(top, above);
    edges_.set_outgoing(bottom, below_at_v);
    quadrics_[to] += quadrics_[v];
    is_removed_[v] = true;
    face_count_ -= 2;
    enqueue(to);
    ring_.clear();
    edges_.visit_ring(to, [&](Index neighbour) { ring_.push_back(neighbour); });
    for (const Index neighbour : ring_) enqueue(neighbour);
  }

  DirectedEdges<Edge> edges_;
  std::vector<algebra3d::Quadric> quadrics_;  // per vertex
  std::vector<std::uint32_t> versions_;       // per vertex; those of candidates that still hold
  std::vector<bool> is_removed_;              // per vertex
  std::size_t face_count_;
  std::priority_queue<Candidate> queue_;
  mutable std::vector<Index> neighbours_;
  std::vector<Index> moved_, ring_;
};

}  // namespace bench::structures
