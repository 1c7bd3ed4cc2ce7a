#include "algebra3d/kernel/planar/detail/plane_points.h"

#include <algorithm>
#include <cmath>
#include <compare>

#include "base/interruption_scope.h"

namespace algebra3d::planar {
namespace {

/// A point on its way into order, with its coordinates at hand.
struct SortedPoint {
  double x, y;
  std::uint32_t index;
};

/// Vertices to a strip for each vertex across: long and narrow strips make the seams between them many, wide ones those
/// within; measured, and flat.
constexpr double kStripShape = 16;

/// Orders points by one axis upwards, and where that is equal by the other, upwards or downwards.
class PointOrder {
 public:
  PointOrder(const PointArray& points, bool has_exact) : points_(points), has_exact_(has_exact) {}

  bool by_x(const SortedPoint& a, const SortedPoint& b) const {
    if (a.x != b.x) return a.x < b.x;
    if (!has_exact_) return a.y != b.y ? a.y < b.y : a.index < b.index;
    const auto order = compare(points_[a.index], points_[b.index]);
    return std::is_neq(order) ? std::is_lt(order) : a.index < b.index;
  }
  /// What `by_x` is after a quarter turn clockwise.
  bool by_y(const SortedPoint& a, const SortedPoint& b) const {
    if (a.y != b.y) return a.y < b.y;
    if (!has_exact_) return a.x > b.x;
    const auto order = compare(1, points_[a.index], points_[b.index]);
    return std::is_neq(order) ? std::is_lt(order) : std::is_gt(compare(0, points_[a.index], points_[b.index]));
  }
  bool are_equal(const SortedPoint& a, const SortedPoint& b) const {
    return a.x == b.x && a.y == b.y && (!has_exact_ || equal(points_[a.index], points_[b.index]));
  }

 private:
  const PointArray& points_;
  bool has_exact_;
};

std::size_t strip_count(std::size_t vertex_count) {
  const auto count = static_cast<std::size_t>(std::sqrt(static_cast<double>(vertex_count) / kStripShape));
  return std::clamp<std::size_t>(count, 1, std::max<std::size_t>(1, vertex_count / 2));
}

}  // namespace

PlanePoints::PlanePoints(const PointArray& points, const std::vector<std::uint32_t>& indices)
    : points_(points), has_exact_(points.exact_count() != 0), vertices_(points.size()) {
  const PointOrder order(points, has_exact_);
  std::vector<SortedPoint> sorted;
  sorted.reserve(indices.size());
  for (const std::uint32_t i : indices) sorted.push_back({points.approx()[i].x, points.approx()[i].y, i});
  std::sort(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) {
    poll_interruption();
    return order.by_x(a, b);
  });
  // Of equal points the lowest index comes first.
  std::vector<std::uint32_t> first_of_equal(points.size(), kNone);
  std::size_t count = 0;
  for (const SortedPoint& p : sorted) {
    if (count == 0 || !order.are_equal(sorted[count - 1], p)) sorted[count++] = p;
    first_of_equal[p.index] = sorted[count - 1].index;
  }
  sorted.resize(count);
  const std::size_t strips = strip_count(count);
  for (std::size_t s = 0; s < strips; ++s) {
    const auto begin = sorted.begin() + static_cast<std::ptrdiff_t>(s * count / strips);
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>((s + 1) * count / strips);
    std::sort(begin, end, [&](const auto& a, const auto& b) {
      poll_interruption();
      return order.by_y(a, b);
    });
    strip_ends_.emplace_back(end - sorted.begin());
  }
  places_.reserve(count);
  indices_.reserve(count);
  for (const SortedPoint& p : sorted) {
    vertices_[p.index] = places_.push_back({p.x, p.y});
    indices_.push_back(p.index);
  }
  for (const std::uint32_t i : indices) vertices_[i] = vertices_[first_of_equal[i]];
}

int PlanePoints::decide_turn(VertexId a, VertexId b, VertexId c) const {
  return orient2d(Projection::xy, (*this)[a], (*this)[b], (*this)[c]);
}

bool PlanePoints::decide_in_circle(VertexId a, VertexId b, VertexId c, VertexId d) const {
  if (d == a || d == b || d == c) return false;
  const int sign = in_circle((*this)[a], (*this)[b], (*this)[c], (*this)[d]);
  if (sign != 0) return sign > 0;
  // The determinant is linear in the height of each point; the factor of the raised one, which is the area of the
  // others, is not 0, since no three different points of a circle lie on a line.
  VertexId last = a;
  for (const VertexId v : {b, c, d})
    if (is_before(last, v)) last = v;
  if (last == d) return false;
  return (last == a ? turn(d, b, c) : last == b ? turn(a, d, c) : turn(a, b, d)) > 0;
}

std::vector<std::uint32_t> ends_of(const PointArray& points, std::span<const DirectedEdge> edges) {
  std::vector<bool> is_end(points.size());
  for (const auto& [from, to] : edges) is_end[from] = is_end[to] = true;
  std::vector<std::uint32_t> ends;
  for (std::uint32_t i = 0; i < is_end.size(); ++i)
    if (is_end[i]) ends.push_back(i);
  return ends;
}

}  // namespace algebra3d::planar
