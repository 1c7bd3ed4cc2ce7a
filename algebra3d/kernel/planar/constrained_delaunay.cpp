#include "algebra3d/kernel/planar/constrained_delaunay.h"

#include <algorithm>
#include <array>
#include <utility>

#include "algebra3d/kernel/planar/detail/cycles.h"
#include "algebra3d/kernel/planar/detail/edge_triangulation.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using Triangle = IndexTriangle;

/// Each begins with its lowest index: by that and the next. There are few of one first corner, so they are sorted by it
/// in linear time.
std::vector<Triangle> in_order(const std::vector<Triangle>& triangles, std::size_t point_count) {
  std::vector<std::uint32_t> ends(point_count + 1);
  for (const Triangle& t : triangles) ++ends[t[0] + 1];
  for (std::size_t i = 1; i < ends.size(); ++i) ends[i] += ends[i - 1];
  std::vector<Triangle> result(triangles.size());
  for (const Triangle& t : triangles) result[ends[t[0]]++] = t;
  std::uint32_t begin = 0;
  for (std::size_t i = 0; i < point_count; ++i) {
    std::sort(result.begin() + begin, result.begin() + ends[i]);
    begin = ends[i];
  }
  return result;
}

/// By indices of points, each beginning with its lowest one.
std::vector<Triangle> by_indices(const planar::PlanePoints& points,
                                 const std::vector<std::array<planar::VertexId, 3>>& triangles) {
  std::vector<Triangle> result;
  result.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    Triangle& t = result.emplace_back(Triangle{points.index(a), points.index(b), points.index(c)});
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  return result;
}

}  // namespace

Result<std::vector<IndexTriangle>> constrained_delaunay(const PointArray& points, std::span<const DirectedEdge> edges,
                                                        const Monitor& monitor) {
  planar::EdgeTriangulation triangulation(points, edges);
  A3D_TRY(triangulation.build(monitor));
  A3D_ASSIGN(const planar::InsideTriangles inside, triangulation.find_inside());
  return in_order(by_indices(triangulation.points(), inside.corners), points.size());
}

Result<std::vector<IndexTriangle>> triangulate(const Polygons& valid, const Monitor& monitor) {
  return constrained_delaunay(valid.corners, planar::segments_of(valid, planar::reversed_cycles(valid)), monitor);
}

}  // namespace algebra3d
