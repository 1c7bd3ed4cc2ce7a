#include "algebra3d/kernel/arrangement/detail/radial_order.h"

#include <algorithm>
#include <cassert>

#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d::arrangement {
namespace {

/// Sign of d (m x n), where d runs from u to v and m, n are the normals of the two planes. A left half-plane turned by
/// a right angle is its plane's normal, so the angles between left half-planes are those between normals.
int turn_of_normals(const Subdivision& subdivision, SubEdgeId a, SubEdgeId b) {
  if (subdivision.sub_edges[a].plane == subdivision.sub_edges[b].plane) return 0;
  const Plane& plane_a = subdivision.plane_of(a);
  const TriangleRef in_b = subdivision.plane_of(b).triangle();
  const SpaceEdge ends = subdivision.sub_edges[a].ends;
  const PointRef u = subdivision.complex.nodes[ends.u], v = subdivision.complex.nodes[ends.v];
  for (const PointRef& corner : plane_a.triangle()) {
    const int side = orient2d(plane_a.projection, u, v, corner);
    // The direction to the left of the line is m x d, and n (m x d) = - d (m x n).
    if (side != 0) return -side * orient3d(in_b[0], in_b[1], in_b[2], corner);
  }
  assert(false && "a triangle on a line");
  return 0;
}

}  // namespace

int turn_around_line(const Subdivision& subdivision, SubEdgeSide a, SubEdgeSide b) {
  const int normals = turn_of_normals(subdivision, a.sub_edge(), b.sub_edge());
  return a.side() == b.side() ? normals : -normals;
}

void sort_around_space_edge(const Subdivision& subdivision, std::span<SubEdgeSide> half_planes) {
  if (half_planes.size() < 3) return;
  struct Turned {
    int half;  ///< 0 within the first half turn, 1 opposite, 2 beyond
    SubEdgeSide half_plane;
  };
  std::vector<Turned> turned;
  turned.reserve(half_planes.size());
  for (const SubEdgeSide h : half_planes.subspan(1))
    turned.push_back({1 - turn_around_line(subdivision, half_planes[0], h), h});
  std::ranges::stable_sort(turned, [&](const Turned& a, const Turned& b) {
    return a.half != b.half ? a.half < b.half : turn_around_line(subdivision, a.half_plane, b.half_plane) > 0;
  });
  for (std::size_t i = 0; i < turned.size(); ++i) half_planes[i + 1] = turned[i].half_plane;
}

void covered_half_planes(const SubEdges& sub_edges, IdRange<SubEdgeId> edge, std::vector<SubEdgeSide>& result) {
  result.clear();
  for (const SubEdgeId s : edge)
    for (const Side side : kSides)
      if (sub_edges.is_covered({s, side})) result.emplace_back(s, side);
}

void half_planes_with_jumps(const WindingJumps& jumps, IdRange<SubEdgeId> edge, std::vector<SubEdgeSide>& result) {
  result.clear();
  for (const SubEdgeId s : edge)
    for (const Side side : kSides)
      if (jumps[{s, side}] != WindingVector()) result.emplace_back(s, side);
}

}  // namespace algebra3d::arrangement
