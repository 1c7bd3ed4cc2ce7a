#include "algebra3d/kernel/arrangement/detail/crossings.h"

#include <algorithm>
#include <utility>

#include "algebra3d/kernel/arrangement/detail/task_sizes.h"
#include "base/scheduler.h"

namespace algebra3d::arrangement {

ExactPoint Crossings::meeting_point(const EdgeAndPlane& where) {
  const PointRef from = start(where.edge), to = end(where.edge);
  const TriangleRef triangle = facets_.planes[where.plane].triangle();
  if (from.is_double() && to.is_double() && std::ranges::all_of(triangle, &PointRef::is_double))
    return intersect_line_plane(from, to, triangle);
  const IntegerPlane& plane = complex_.coefficients.get(facets_, where.plane);
  if (std::optional<ExactPoint> point = point_by_planes(where.edge, plane)) return *std::move(point);
  return intersect_line_plane(from, to, plane);
}

/// From the planes on both sides of the edge, if these are known: they are shorter than its ends, of which most would
/// be a common divisor.
std::optional<ExactPoint> Crossings::point_by_planes(InputEdgeId edge, const IntegerPlane& plane) const {
  const InputHalfedgeId halfedge = Operands::halfedge(edge), opposite = operands_.opposite(halfedge);
  if (opposite.is_none()) return std::nullopt;
  const IntegerPlane* first = operands_.plane(Operands::face(halfedge));
  const IntegerPlane* second = operands_.plane(Operands::face(opposite));
  if (first == nullptr || second == nullptr) return std::nullopt;
  return common_point(*first, *second, plane);
}

void Crossings::compute(std::span<const EdgeAndPlane> wanted) {
  std::vector<EdgeAndPlane> missing;
  first_point_ = nodes_.next_id();
  for (const EdgeAndPlane& where : wanted) {
    CrossingId& crossing = of_edges_and_planes_[where.key()];
    if (!crossing.is_none()) continue;
    crossing = nodes_.push_back({});
    missing.push_back(where);
  }
  points_.assign(missing.size(), {});
  parallel_for(missing.size(), kPointsPerTask, [&](std::size_t i) { points_[i] = meeting_point(missing[i]); });
}

ExactPoint Crossings::take_point(CrossingId crossing, const EdgeAndPlane& where) {
  const std::size_t place = crossing.index() - std::size_t{first_point_.index()};
  return place < points_.size() ? std::move(points_[place]) : meeting_point(where);
}

void Crossings::reserve(std::size_t count) {
  of_edges_and_planes_.reserve(count);
  nodes_.reserve(count);
}

NodeId Crossings::of_edge_and_plane(const EdgeAndPlane& where) {
  CrossingId& known = of_edges_and_planes_[where.key()];
  if (known.is_none()) known = nodes_.push_back({});
  NodeId& node = nodes_[known];
  if (node.is_none()) node = complex_.nodes.intern(take_point(known, where));
  return node;
}

NodeId Crossings::of_planes(PlaneId p, PlaneId q, PlaneId r) {
  std::array<PlaneId, 3> planes{p, q, r};
  std::ranges::sort(planes);
  const auto [entry, is_new] = of_planes_.try_emplace(planes);
  if (is_new) {
    PlaneCoefficients& known = complex_.coefficients;
    entry->second =
        complex_.nodes.intern(intersect_planes(known.get(facets_, p), known.get(facets_, q), known.get(facets_, r)));
  }
  return entry->second;
}

NodeId Crossings::of_edges(InputEdgeId edge, InputEdgeId other, Projection projection) {
  // The plane through the other edge along the axis that the projection leaves out.
  const IntegerPlane plane = IntegerPlane::along_axis(start(other), end(other), static_cast<std::size_t>(projection));
  return complex_.nodes.intern(intersect_line_plane(start(edge), end(edge), plane));
}

}  // namespace algebra3d::arrangement
