#include "algebra3d/values/conversions/detail/ring_triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/planar/sweep_triangulation.h"

namespace algebra3d {
namespace {

/// Twice the vector area, rounded. Source: [newell1972], as sums of cross products.
Vec3 vector_area(const PointTable& points, const PointRing& ring) {
  const Vec3 origin = points[ring.front()].approx;
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    sum = sum + cross(points[ring[i]].approx - origin, points[ring[i + 1]].approx - origin);
  return sum;
}

/// The axes, that of the largest component first.
std::array<std::size_t, 3> axes_by_size(const Vec3& normal) {
  std::array<std::size_t, 3> axes{2, 1, 0};
  std::ranges::stable_sort(axes,
                           [&](std::size_t a, std::size_t b) { return std::abs(normal[a]) > std::abs(normal[b]); });
  return axes;
}

/// The edges of a ring, or these turned.
void add_edges(const PointRing& ring, bool is_turned, std::vector<DirectedEdge>& edges) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto from = ring[i], to = ring[(i + 1) % ring.size()];
    edges.push_back(is_turned ? DirectedEdge(to, from) : DirectedEdge(from, to));
  }
}

}  // namespace

bool triangulate_rings(const PointTable& points, std::span<const PointRing> rings,
                       std::vector<IndexTriangle>& triangles) {
  std::vector<Vec3> areas;
  for (const PointRing& ring : rings) areas.push_back(vector_area(points, ring));
  for (const std::size_t axis : axes_by_size(areas.front())) {
    const bool is_flipped = areas.front()[axis] < 0;
    std::vector<DirectedEdge> edges;
    // The polygon lies to the left of its edges: the outer ring runs counter-clockwise, holes clockwise.
    for (std::size_t i = 0; i < rings.size(); ++i) add_edges(rings[i], (areas[i][axis] < 0) == (i == 0), edges);
    std::vector<IndexTriangle> found;
    if (!triangulate_by_sweep(points, static_cast<Projection>(axis), edges, found)) continue;
    for (IndexTriangle& triangle : found) {
      if (is_flipped) std::swap(triangle[1], triangle[2]);
      triangles.push_back(triangle);
    }
    return true;
  }
  return false;
}

}  // namespace algebra3d
