#include "algebra3d/planar/constrained_delaunay.h"

#include <algorithm>
#include <array>
#include <utility>

#include "algebra3d/planar/constraints.h"
#include "algebra3d/planar/cycles.h"
#include "algebra3d/planar/delaunay.h"
#include "algebra3d/planar/regions.h"
#include "algebra3d/planar/segment_text.h"

namespace algebra3d {
namespace {

using planar::PlanePoints;
using planar::Subdivision;
using Triangle = TriangleMesh::Triangle;

/// The triangulation of the ends of some edges, while the edges are put in.
class EdgeTriangulation {
 public:
  EdgeTriangulation(const PointArray& points, std::span<const DirectedEdge> edges)
      : edges_(edges), points_(points, planar::ends_of(points, edges)), triangulation_(0) {}

  Status build(const Monitor& monitor);
  Result<std::vector<Triangle>> inside() const;

 private:
  Status insert(std::uint32_t edge, planar::ConstraintInserter& inserter);
  std::string text_of(std::uint32_t edge) const {
    const auto& [from, to] = edges_[edge];
    return planar::segment_text(points_[points_.vertex_of(from)], points_[points_.vertex_of(to)]);
  }

  std::span<const DirectedEdge> edges_;
  PlanePoints points_;
  Subdivision triangulation_;
};

Status EdgeTriangulation::insert(std::uint32_t edge, planar::ConstraintInserter& inserter) {
  const std::uint32_t from = points_.vertex_of(edges_[edge].first), to = points_.vertex_of(edges_[edge].second);
  if (from == to) return {};
  if (!inserter.insert(from, to)) {
    const std::uint32_t other = planar::segment_of_mark(triangulation_.mark(inserter.crossing()));
    return Error{ErrorCode::invalid_value, "segment {} crosses segment {}", text_of(edge), text_of(other)};
  }
  for (const std::uint32_t h : inserter.along()) {
    const std::uint32_t mark = triangulation_.mark(h);
    if (!planar::mark_segment(triangulation_, h, edge))
      return Error{ErrorCode::invalid_value, "segment {} overlaps segment {}", text_of(edge),
                   text_of(planar::segment_of_mark(mark))};
  }
  return {};
}

Status EdgeTriangulation::build(const Monitor& monitor) {
  ASSIGN_OR_RETURN(triangulation_, planar::delaunay(points_, monitor));
  Stage stage(monitor, "triangulating", edges_.size());
  planar::ConstraintInserter inserter(points_, triangulation_);
  for (std::uint32_t edge = 0; edge < edges_.size(); ++edge) {
    if (!stage.begin_step()) return Monitor::interrupted();
    RETURN_IF_ERROR(insert(edge, inserter));
  }
  return {};
}

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

Result<std::vector<Triangle>> EdgeTriangulation::inside() const {
  const planar::InsideTriangles found = find_inside(triangulation_);
  if (found.wrong_halfedge) {
    const std::uint32_t h = *found.wrong_halfedge;
    return Error{ErrorCode::invalid_value, "the segments bound no region: the inside meets the outside at {}",
                 planar::segment_text(points_[triangulation_.origin(h)], points_[triangulation_.target(h)])};
  }
  std::vector<Triangle> triangles;
  triangles.reserve(found.halfedges.size());
  std::uint32_t largest = 0;
  for (const std::uint32_t h : found.halfedges) {
    const std::uint32_t second = triangulation_.next(h);
    Triangle t{points_.index(triangulation_.origin(h)), points_.index(triangulation_.origin(second)),
               points_.index(triangulation_.target(second))};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    largest = std::max(largest, t[0]);
    triangles.push_back(t);
  }
  return in_order(triangles, std::size_t{largest} + 1);
}

}  // namespace

Result<std::vector<TriangleMesh::Triangle>> constrained_delaunay(const PointArray& points,
                                                                 std::span<const DirectedEdge> edges,
                                                                 const Monitor& monitor) {
  EdgeTriangulation triangulation(points, edges);
  RETURN_IF_ERROR(triangulation.build(monitor));
  return triangulation.inside();
}

Result<std::vector<TriangleMesh::Triangle>> triangulate(const Polygons& valid, const Monitor& monitor) {
  return constrained_delaunay(valid.corners, planar::segments_of(valid, planar::reversed_cycles(valid)), monitor);
}

}  // namespace algebra3d
