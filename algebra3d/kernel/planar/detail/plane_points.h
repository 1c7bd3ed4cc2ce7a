#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/kernel/exact/in_circle.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/planar/detail/ids.h"
#include "base/id_vector.h"
#include "base/indices.h"

namespace algebra3d::planar {

/// The vertices of a triangulation: the given points, equal ones merged, numbered in strips from left to right and
/// within a strip from bottom to top, so that neighbours in the plane are mostly neighbours in memory. Refers to the
/// points, which must outlive it. Invariant: each strip has at least two vertices, if there are two. Decisions are
/// exact. Concurrent reading is safe.
class PlanePoints {
 public:
  /// Takes the points with these indices, which may repeat.
  PlanePoints(const PointArray& points, const std::vector<std::uint32_t>& indices);

  std::size_t size() const { return places_.size(); }
  /// One past the last vertex of each strip.
  const std::vector<VertexId>& strip_ends() const { return strip_ends_; }
  /// The lowest index of the points of this vertex.
  std::uint32_t index(VertexId vertex) const { return indices_[vertex]; }
  /// The vertex of a point; none if the point was not given.
  VertexId vertex_of(std::uint32_t index) const { return vertices_[index]; }
  PointRef operator[](VertexId vertex) const { return points_[indices_[vertex]]; }

  /// Sign of the area: 1 if the three turn counter-clockwise.
  int turn(VertexId a, VertexId b, VertexId c) const {
    const int sign = has_exact_ ? detail::kUndecided : filter_turn(places_[a], places_[b], places_[c]);
    return sign != detail::kUndecided ? sign : decide_turn(a, b, c);
  }
  /// True if d lies inside the circle through a, b, c, which turn counter-clockwise. Ties are broken by symbolic
  /// perturbation: of four different points on a circle the last one by x and y counts as raised from the paraboloid z
  /// = x^2 + y^2. So the Delaunay triangulation is unique, and points on a circle are joined in zigzag and not in fans.
  /// Source: [devillers2011].
  bool is_in_circle(VertexId a, VertexId b, VertexId c, VertexId d) const {
    const int sign =
        has_exact_ ? detail::kUndecided : detail::filter_in_circle(places_[a], places_[b], places_[c], places_[d]);
    return sign != detail::kUndecided ? sign > 0 : decide_in_circle(a, b, c, d);
  }
  /// Order by x, then by y.
  bool is_before(VertexId a, VertexId b) const {
    const auto &p = places_[a], &q = places_[b];
    if (p.x != q.x) return p.x < q.x;
    return has_exact_ ? std::is_lt(compare((*this)[a], (*this)[b])) : p.y < q.y;
  }

 private:
  using Place = detail::PlaneVec;

  static int filter_turn(const Place& a, const Place& b, const Place& c) {
    const double left = (b.x - a.x) * (c.y - a.y);
    const double right = (b.y - a.y) * (c.x - a.x);
    const double determinant = left - right;
    const double error = detail::kOrient2dError * (std::abs(left) + std::abs(right)) + detail::kUnderflowError;
    if (determinant > error) return 1;
    if (determinant < -error) return -1;
    return detail::kUndecided;
  }
  int decide_turn(VertexId a, VertexId b, VertexId c) const;
  bool decide_in_circle(VertexId a, VertexId b, VertexId c, VertexId d) const;

  const PointArray& points_;
  bool has_exact_;
  IdVector<VertexId, Place> places_;           // of each vertex; rounded
  IdVector<VertexId, std::uint32_t> indices_;  // of each vertex
  std::vector<VertexId> vertices_;             // of each point
  std::vector<VertexId> strip_ends_;
};

/// The indices of the ends of edges, ascending, without duplicates.
std::vector<std::uint32_t> ends_of(const PointArray& points, std::span<const DirectedEdge> edges);

}  // namespace algebra3d::planar
