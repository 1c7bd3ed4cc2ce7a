#include "algebra3d/kernel/convex/detail/hull_facets.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "algebra3d/kernel/convex/detail/hull_plane.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "base/id_vector.h"
#include "base/interruption_scope.h"

namespace algebra3d::detail {
namespace {

class FacetJoiner {
 public:
  FacetJoiner(const PointArray& points, const std::vector<HullTriangle>& triangles)
      : points_(points), triangles_(triangles), is_crease_(3 * triangles.size()), crease_counts_(points.size()) {
    const CoordinateBounds bounds(points);
    for (std::size_t f = 0; f < triangles.size(); ++f) find_creases(FaceId(f), bounds);
  }

  HullBoundary boundary() {
    HullBoundary result;
    for (std::size_t v = 0; v < points_.size(); ++v)
      if (is_extreme(VertexId(v))) result.extreme_points.emplace_back(v);
    std::ranges::sort(result.extreme_points,
                      [&](VertexId a, VertexId b) { return compare(points_[a.index()], points_[b.index()]) < 0; });
    numbers_.resize(points_.size());
    for (std::size_t i = 0; i < result.extreme_points.size(); ++i) {
      poll_interruption_at(i);
      numbers_[result.extreme_points[i]] = static_cast<std::uint32_t>(i);
    }
    is_done_.resize(is_crease_.size());
    for (std::size_t h = 0; h < is_crease_.size(); ++h)
      if (is_crease_[h] && !is_done_[h]) divide_facet(HalfedgeId(h), result.triangles);
    std::ranges::sort(result.triangles);
    return result;
  }

 private:
  /// An edge is a crease if its triangles are not coplanar.
  void find_creases(FaceId face, const CoordinateBounds& bounds) {
    const HullTriangle& triangle = triangles_[face.index()];
    const auto point = [&](std::size_t i) { return points_[triangle.corners[i].index()]; };
    const HullPlane plane({point(0).approx, point(1).approx, point(2).approx}, bounds);
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const FaceId neighbour = triangle.neighbours[edge];
      if (neighbour < face) continue;
      const HalfedgeId opposite = opposite_of(face, edge);
      const PointRef beyond = points_[origin(previous(opposite)).index()];
      int side = plane.side(plane.height(beyond.approx));
      if (side == kUndecided) side = orient3d(point(0), point(1), point(2), beyond);
      if (side == 0) continue;
      for (const HalfedgeId h : {halfedge(face, edge), opposite}) {
        is_crease_[h.index()] = true;
        ++crease_counts_[origin(h)];
      }
    }
  }

  static HalfedgeId halfedge(FaceId face, std::size_t edge) { return HalfedgeId(3 * std::size_t{face.index()} + edge); }
  static HalfedgeId next(HalfedgeId h) { return HalfedgeId(h.index() % 3 == 2 ? h.index() - 2 : h.index() + 1); }
  static HalfedgeId previous(HalfedgeId h) { return HalfedgeId(h.index() % 3 == 0 ? h.index() + 2 : h.index() - 1); }
  VertexId origin(HalfedgeId h) const { return triangles_[h.index() / 3].corners[h.index() % 3]; }
  HalfedgeId opposite_of(FaceId face, std::size_t edge) const {
    const HullTriangle& triangle = triangles_[face.index()];
    const FaceId neighbour = triangle.neighbours[edge];
    const auto& corners = triangles_[neighbour.index()].corners;
    const auto place = std::ranges::find(corners, triangle.corners[(edge + 1) % 3]) - corners.begin();
    return halfedge(neighbour, static_cast<std::size_t>(place));
  }

  /// A corner inside a facet has no creases, one inside an edge of the hull has two.
  bool is_extreme(VertexId point) const { return crease_counts_[point] >= 3; }

  /// The crease that follows around the same facet.
  HalfedgeId next_crease(HalfedgeId h) const {
    h = next(h);
    while (!is_crease_[h.index()]) h = next(opposite_of(FaceId(h.index() / 3), h.index() % 3));
    return h;
  }

  /// Divides the facet to the left of a crease.
  void divide_facet(HalfedgeId first, std::vector<IndexTriangle>& triangles) {
    facet_.clear();
    HalfedgeId h = first;
    do {
      is_done_[h.index()] = true;
      if (is_extreme(origin(h))) facet_.push_back(numbers_[origin(h)]);
      h = next_crease(h);
    } while (h != first);
    std::rotate(facet_.begin(), std::ranges::min_element(facet_), facet_.end());
    for (std::size_t i = 2; i < facet_.size(); ++i) triangles.push_back({facet_[0], facet_[i - 1], facet_[i]});
  }

  const PointArray& points_;
  const std::vector<HullTriangle>& triangles_;
  std::vector<bool> is_crease_, is_done_;  // by half-edge
  IdVector<VertexId, std::uint32_t> crease_counts_;
  IdVector<VertexId, std::uint32_t> numbers_;  // of extreme points
  std::vector<std::uint32_t> facet_;
};

}  // namespace

HullBoundary hull_boundary(const PointArray& points, const std::vector<HullTriangle>& triangles) {
  return FacetJoiner(points, triangles).boundary();
}

}  // namespace algebra3d::detail
