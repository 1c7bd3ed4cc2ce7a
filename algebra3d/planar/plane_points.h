#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/exact/in_circle.h"
#include "algebra3d/exact/predicates.h"
#include "algebra3d/planar/directed_edge.h"

namespace algebra3d::planar {

inline constexpr std::uint32_t kNone = 0xFFFFFFFF;

/// The vertices of a triangulation: given points, equal ones merged, numbered by place: in strips from left to right,
/// and within a strip from bottom to top, so that neighbours in the plane are mostly neighbours in memory. Refers to
/// the points, which must outlive it. Invariant: each strip has two vertices at least, if there are two. Decisions are
/// exact. Concurrent reading is safe.
class PlanePoints {
 public:
  /// Of the points of these indices, any of which may occur several times.
  PlanePoints(const PointArray& points, const std::vector<std::uint32_t>& indices);

  std::uint32_t size() const { return static_cast<std::uint32_t>(places_.size()); }
  /// One past the last vertex of each strip.
  const std::vector<std::uint32_t>& strip_ends() const { return strip_ends_; }
  /// The lowest index of the points that are this vertex.
  std::uint32_t index(std::uint32_t vertex) const { return indices_[vertex]; }
  /// The vertex of a point; kNone if it was not asked for.
  std::uint32_t vertex_of(std::uint32_t index) const { return vertices_[index]; }
  PointRef operator[](std::uint32_t vertex) const { return points_[indices_[vertex]]; }

  /// Sign of the area: 1 if the three turn counter-clockwise.
  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const int sign = has_exact_ ? detail::kUndecided : filter_turn(places_[a], places_[b], places_[c]);
    return sign != detail::kUndecided ? sign : decide_turn(a, b, c);
  }
  /// True if d lies within the circle through a, b, c, which turn counter-clockwise. Of four different points on a
  /// circle the last one by x and y counts as raised a little from the paraboloid z = x^2 + y^2 on which the circles
  /// are planes. So for different points there is one Delaunay triangulation, one answer for each of its circles, and
  /// points on a circle are joined in zigzag and not in fans. Source: [devillers2011].
  bool is_in_circle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    const int sign =
        has_exact_ ? detail::kUndecided : detail::filter_in_circle(places_[a], places_[b], places_[c], places_[d]);
    return sign != detail::kUndecided ? sign > 0 : decide_in_circle(a, b, c, d);
  }
  /// By x, then by y.
  bool is_before(std::uint32_t a, std::uint32_t b) const {
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
  int decide_turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  bool decide_in_circle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const;
  void number(std::vector<std::uint32_t>& order);

  const PointArray& points_;
  bool has_exact_;
  std::vector<Place> places_;            // of each vertex; rounded
  std::vector<std::uint32_t> indices_;   // of each vertex
  std::vector<std::uint32_t> vertices_;  // of each point
  std::vector<std::uint32_t> strip_ends_;
};

/// The indices that are ends of edges, each once, ascending.
std::vector<std::uint32_t> ends_of(const PointArray& points, std::span<const DirectedEdge> edges);

}  // namespace algebra3d::planar
