#include "algebra3d/kernel/planar/detail/constraints.h"

#include "base/interruption_scope.h"

namespace algebra3d::planar {

/// The half-edge between the vertices; none if there is none.
HalfedgeId ConstraintInserter::find_edge(VertexId from, VertexId to) const {
  const HalfedgeId first = triangulation_.halfedge_of(from);
  HalfedgeId h = first;
  do {
    if (triangulation_.target(h) == to) return h;
    h = triangulation_.ccw(h);
  } while (h != first);
  return {};
}

/// The last half-edge at `from` to the right of the line, with the next one to its left; or one that lies on it.
HalfedgeId ConstraintInserter::find_wedge(VertexId from, VertexId to) const {
  const HalfedgeId first = triangulation_.halfedge_of(from);
  HalfedgeId h = first;
  int side = points_.turn(from, to, triangulation_.target(h));
  for (;;) {
    const bool is_forward = points_.is_before(from, to) == points_.is_before(from, triangulation_.target(h));
    if (side == 0 && is_forward) return h;
    const HalfedgeId after = triangulation_.ccw(h);
    const int side_after = points_.turn(from, to, triangulation_.target(after));
    if (side < 0 && side_after > 0) return h;
    h = after;
    side = side_after;
  }
}

bool ConstraintInserter::insert(VertexId from, VertexId to) {
  along_.clear();
  while (from != to) {
    if (const HalfedgeId h = find_edge(from, to); !h.is_none()) {
      along_.push_back(h);
      return true;
    }
    if (!cut(from, to)) return false;
  }
  return true;
}

/// Makes the line an edge as far as the first vertex on it, to which `from` moves.
bool ConstraintInserter::cut(VertexId& from, VertexId to) {
  Subdivision& t = triangulation_;
  const HalfedgeId wedge = find_wedge(from, to);
  if (points_.turn(from, to, t.target(wedge)) == 0) {
    along_.push_back(wedge);
    from = t.target(wedge);
    return true;
  }
  crossed_.clear();
  // From a vertex on the right of the line to one on its left; the vertices behind lie to its right.
  HalfedgeId crossed = t.next(wedge);
  HalfedgeId last;
  for (;;) {
    if (t.mark(crossed) != 0) {
      crossing_ = crossed;
      return false;
    }
    crossed_.push_back(crossed);
    const HalfedgeId from_right = t.next(Subdivision::twin(crossed));
    const VertexId apex = t.target(from_right);
    const int side = apex == to ? 0 : points_.turn(from, to, apex);
    last = t.next(from_right);  // from the apex to the left end of `crossed`
    if (side == 0) break;
    crossed = side > 0 ? from_right : last;
  }
  for (const HalfedgeId h : crossed_) t.remove(h);
  const HalfedgeId added = t.add_after(wedge, last);
  along_.push_back(added);
  from = t.target(added);
  fill(added);
  fill(Subdivision::twin(added));
  return true;
}

/// The vertex of the face to the left with which the edge forms a triangle that holds no other in its circle. All
/// vertices of the face see a place on the inserted line, and so those that the circle holds see each other.
/// Gives the half-edge that arrives there.
HalfedgeId ConstraintInserter::find_apex(HalfedgeId base) const {
  const Subdivision& t = triangulation_;
  const VertexId a = t.origin(base), b = t.target(base);
  HalfedgeId best = t.next(base);
  std::size_t looked_at = 0;
  for (HalfedgeId h = t.next(best); t.target(h) != a || t.next(h) != base; h = t.next(h)) {
    poll_interruption_at(++looked_at);
    if (t.target(h) == t.target(best) ? is_seen(h, a) : points_.is_in_circle(a, b, t.target(best), t.target(h)))
      best = h;
  }
  return best;
}

/// True if the corner of the face behind the half-edge, at its target, is open towards the vertex. It always is where
/// the face has but one corner there; at the root of an edge that juts out into the face it has two.
bool ConstraintInserter::is_seen(HalfedgeId arriving, VertexId vertex) const {
  const VertexId corner = triangulation_.target(arriving), back = triangulation_.origin(arriving);
  const VertexId ahead = triangulation_.target(triangulation_.next(arriving));
  if (vertex == ahead || ahead == back) return true;
  const int wedge = points_.turn(corner, ahead, back);
  const int from_ahead = points_.turn(corner, ahead, vertex), to_back = points_.turn(corner, vertex, back);
  return wedge > 0 ? from_ahead > 0 && to_back > 0 : wedge == 0 ? from_ahead > 0 : from_ahead > 0 || to_back > 0;
}

/// Triangulates the face to the left of an edge.
void ConstraintInserter::fill(HalfedgeId base) {
  Subdivision& t = triangulation_;
  open_.assign(1, base);
  while (!open_.empty()) {
    const HalfedgeId edge = open_.back();
    open_.pop_back();
    const HalfedgeId first = t.next(edge);
    if (t.next(t.next(first)) == edge) continue;
    const HalfedgeId arriving = find_apex(edge);
    const HalfedgeId leaving = t.next(arriving);
    HalfedgeId right = first;
    if (arriving != first) {
      right = t.connect(edge, leaving);
      open_.push_back(Subdivision::twin(right));
    }
    if (t.next(leaving) != edge) open_.push_back(Subdivision::twin(t.connect(right, edge)));
  }
}

}  // namespace algebra3d::planar
