#include "algebra3d/kernel/planar/polygon_validity.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/kernel/planar/detail/constraints.h"
#include "algebra3d/kernel/planar/detail/cycles.h"
#include "algebra3d/kernel/planar/detail/delaunay.h"
#include "algebra3d/kernel/planar/detail/face_claims.h"
#include "algebra3d/kernel/planar/detail/polygon_places.h"
#include "algebra3d/kernel/planar/segment_text.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using planar::HalfedgeId;
using planar::PlanePoints;
using planar::SegmentId;
using planar::Subdivision;
using planar::VertexId;
using Defect = std::optional<std::string>;

std::vector<std::uint32_t> all_corners(const Polygons& polygons) {
  std::vector<std::uint32_t> corners(polygons.corners.size());
  std::iota(corners.begin(), corners.end(), 0U);
  return corners;
}

/// Defects that a cycle has by itself, but for segments that meet.
Defect defect_of_cycles(const Polygons& polygons, const planar::PolygonPlaces& places) {
  std::uint32_t cycle = 0;
  for (std::uint32_t face = 0; face < polygons.face_count(); ++face) {
    poll_interruption_at(face);
    if (cycle == polygons.face_ends[face]) return fmt::format("face {} has no cycle", face + 1);
    for (std::uint32_t number = 1; cycle < polygons.face_ends[face]; ++cycle, ++number) {
      const std::uint32_t begin = polygons.first_corner(cycle), end = polygons.cycle_ends[cycle];
      if (end - begin < 3)
        return fmt::format("face {}, cycle {} has {} corners, expected at least 3", face + 1, number, end - begin);
      for (std::uint32_t i = begin; i < end; ++i)
        if (equal(polygons.corners[i], polygons.corners[places.after(i)]))
          return places.segment_name(SegmentId(i)) + " has no length";
    }
  }
  return std::nullopt;
}

/// Puts segment after segment into the triangulation of the corners, until one does not fit.
class SegmentCheck {
 public:
  SegmentCheck(const Polygons& polygons, const planar::PolygonPlaces& places, const PlanePoints& points,
               Subdivision& triangulation)
      : polygons_(polygons),
        places_(places),
        points_(points),
        triangulation_(triangulation),
        inserter_(points, triangulation),
        passing_(points.size()) {}

  Defect defect_of_corners() const;
  /// The segment in its direction with the inside to its left.
  Defect insert(SegmentId segment, const DirectedEdge& direction);

 private:
  Defect pass(SegmentId segment, VertexId vertex);
  std::uint32_t corner_of_cycle(std::uint32_t cycle, VertexId vertex);
  void list_corners();
  std::string cross_text(SegmentId segment, SegmentId other) const {
    return places_.segment_name(segment) + " crosses " + places_.segment_name(other);
  }
  std::string overlap_text(SegmentId segment, SegmentId other) const {
    return places_.segment_name(segment) + " overlaps " + places_.segment_name(other);
  }

  const Polygons& polygons_;
  const planar::PolygonPlaces& places_;
  const PlanePoints& points_;
  Subdivision& triangulation_;
  planar::ConstraintInserter inserter_;
  IdVector<VertexId, SegmentId> passing_;          // a segment in which it lies
  IdVector<VertexId, std::uint32_t> corner_ends_;  // of corners_at_; made when first asked for
  std::vector<std::uint32_t> corners_at_;          // corners vertex by vertex
};

/// A corner of a cycle where it has been before.
Defect SegmentCheck::defect_of_corners() const {
  IdVector<VertexId, std::uint32_t> latest(points_.size(), kNone);
  for (std::uint32_t corner = 0; corner < polygons_.corners.size(); ++corner) {
    poll_interruption_at(corner);
    std::uint32_t& cycle = latest[points_.vertex_of(corner)];
    if (cycle == places_.cycle_of(corner)) return places_.corner_name(corner) + " occurs twice";
    cycle = places_.cycle_of(corner);
  }
  return std::nullopt;
}

void SegmentCheck::list_corners() {
  corner_ends_.resize(points_.size());
  const auto count = static_cast<std::uint32_t>(polygons_.corners.size());
  for (std::uint32_t corner = 0; corner < count; ++corner) ++corner_ends_[points_.vertex_of(corner)];
  std::exclusive_scan(corner_ends_.begin(), corner_ends_.end(), corner_ends_.begin(), 0U);
  corners_at_.resize(count);
  for (std::uint32_t corner = 0; corner < count; ++corner)
    corners_at_[corner_ends_[points_.vertex_of(corner)]++] = corner;
}

/// The cycle's corner at the vertex, kNone if it has none. Cost: the number of cycles that have one.
std::uint32_t SegmentCheck::corner_of_cycle(std::uint32_t cycle, VertexId vertex) {
  if (corner_ends_.empty()) list_corners();
  const std::uint32_t begin = vertex.index() == 0 ? 0 : corner_ends_[VertexId(vertex.index() - 1)];
  for (std::uint32_t i = begin; i < corner_ends_[vertex]; ++i)
    if (places_.cycle_of(corners_at_[i]) == cycle) return corners_at_[i];
  return kNone;
}

/// The segment goes through a vertex.
Defect SegmentCheck::pass(SegmentId segment, VertexId vertex) {
  // Two segments within which a point lies cross there, unless they lie on one line, which is found at their edges.
  const SegmentId other = std::exchange(passing_[vertex], segment);
  const std::uint32_t begin = segment.index();  // its corner
  if (!other.is_none()) {
    const bool is_same_line = orient2d(Projection::xy, polygons_.corners[begin],
                                       polygons_.corners[places_.after(begin)], polygons_.corners[other.index()]) == 0;
    return is_same_line ? overlap_text(segment, other) : cross_text(segment, other);
  }
  const std::uint32_t corner = corner_of_cycle(places_.cycle_of(begin), vertex);
  if (corner == kNone) return std::nullopt;
  const VertexId from = points_.vertex_of(begin);
  for (const std::uint32_t end : {places_.after(corner), places_.before(corner)})
    if (points_.turn(from, vertex, points_.vertex_of(end)) == 0)
      return overlap_text(segment, SegmentId(end == places_.after(corner) ? corner : end));
  return places_.corner_name(corner) + " touches " + places_.segment_name(segment);
}

Defect SegmentCheck::insert(SegmentId segment, const DirectedEdge& direction) {
  if (!inserter_.insert(points_.vertex_of(direction.first), points_.vertex_of(direction.second)))
    return cross_text(segment, planar::segment_of_mark(triangulation_.mark(inserter_.crossing())));
  const auto& along = inserter_.along();
  for (std::size_t i = 1; i < along.size(); ++i)
    if (auto defect = pass(segment, triangulation_.origin(along[i]))) return defect;
  for (const HalfedgeId h : along) {
    if (const std::uint32_t mark = triangulation_.mark(h); mark != 0)
      return overlap_text(segment, planar::segment_of_mark(mark));
    planar::mark_segment(triangulation_, h, segment);
  }
  return std::nullopt;
}

/// True if the cycle encloses the point, which does not lie on it.
bool encloses(const Polygons& polygons, std::uint32_t cycle, const PointRef& point) {
  const std::uint32_t begin = polygons.first_corner(cycle), end = polygons.cycle_ends[cycle];
  bool is_inside = false;
  for (std::uint32_t i = begin; i < end; ++i) {
    const PointRef from = polygons.corners[i], to = polygons.corners[i + 1 == end ? begin : i + 1];
    const bool is_from_above = std::is_gt(compare(1, from, point)), is_to_above = std::is_gt(compare(1, to, point));
    if (is_from_above != is_to_above && orient2d(Projection::xy, from, to, point) == (is_to_above ? 1 : -1))
      is_inside = !is_inside;
  }
  return is_inside;
}

/// Says what is wrong about faces that both claim a region, or about one that claims what is outside.
class ConflictText {
 public:
  ConflictText(const Polygons& polygons, const planar::PolygonPlaces& places, const PlanePoints& points,
               const Subdivision& triangulation)
      : polygons_(polygons), places_(places), points_(points), triangulation_(triangulation) {}

  std::string text(const planar::ClaimConflict& conflict) const;

 private:
  /// Whether a point belongs to a face, or the defect of the face there.
  struct Membership {
    bool is_inside = false;
    Defect defect;
  };
  Membership membership(std::uint32_t face, const PointRef& point) const;
  ExactPoint middle(HalfedgeId triangle) const;
  Defect defect_at(const ExactPoint& point, SegmentId segment, SegmentId other) const;
  SegmentId segment_at(HalfedgeId h) const { return planar::segment_of_mark(triangulation_.mark(h)); }
  std::string hole_text(std::uint32_t cycle) const {
    const std::uint32_t corner = polygons_.first_corner(cycle);
    return fmt::format("the hole with segment {} of {}",
                       planar::segment_text(polygons_.corners[corner], polygons_.corners[corner + 1]),
                       places_.cycle_name(corner));
  }

  const Polygons& polygons_;
  const planar::PolygonPlaces& places_;
  const PlanePoints& points_;
  const Subdivision& triangulation_;
};

ConflictText::Membership ConflictText::membership(std::uint32_t face, const PointRef& point) const {
  const std::uint32_t outer = polygons_.first_cycle(face);
  const bool is_in_outer = encloses(polygons_, outer, point);
  std::uint32_t hole = kNone;
  for (std::uint32_t cycle = outer + 1; cycle < polygons_.face_ends[face]; ++cycle) {
    if (!encloses(polygons_, cycle, point)) continue;
    if (!is_in_outer) return {false, hole_text(cycle) + " does not lie inside the outer cycle"};
    if (hole != kNone) return {false, hole_text(cycle) + " and " + hole_text(hole) + " have inner points in common"};
    hole = cycle;
  }
  return {is_in_outer && hole == kNone, std::nullopt};
}

/// The centre of gravity, which lies on no segment.
ExactPoint ConflictText::middle(HalfedgeId triangle) const {
  const HalfedgeId second = triangulation_.next(triangle);
  RationalVec3 sum;
  for (const HalfedgeId h : {triangle, second, triangulation_.next(second)}) {
    const PointRef corner = points_[triangulation_.origin(h)];
    sum.x += corner.coordinate(0);
    sum.y += corner.coordinate(1);
  }
  return ExactPoint(RationalVec3(sum.x / Rational(3), sum.y / Rational(3), Rational()));
}

Defect ConflictText::defect_at(const ExactPoint& point, SegmentId segment, SegmentId other) const {
  const Membership one = membership(places_.face_of(segment), point), two = membership(places_.face_of(other), point);
  if (one.defect) return one.defect;
  if (two.defect) return two.defect;
  if (places_.face_of(segment) == places_.face_of(other) || !one.is_inside || !two.is_inside) return std::nullopt;
  const auto first_segment = [&](SegmentId of) {
    return places_.segment_name(SegmentId(polygons_.first_corner(polygons_.first_cycle(places_.face_of(of)))));
  };
  return fmt::format("{} and {} bound faces with common inner points", first_segment(std::min(segment, other)),
                     first_segment(std::max(segment, other)));
}

/// The claims are wrong within the region or beyond one of the two half-edges: where one of them is right about the
/// region and the other is not, the other is wrong about what lies behind it.
std::string ConflictText::text(const planar::ClaimConflict& conflict) const {
  const SegmentId segment = segment_at(conflict.first);
  const SegmentId other = conflict.second.is_none() ? segment : segment_at(conflict.second);
  for (const HalfedgeId h : {conflict.first, conflict.second}) {
    if (h.is_none()) continue;
    for (const HalfedgeId side : {h, Subdivision::twin(h)}) {
      // The unbounded face is not a triangle that turns counter-clockwise.
      const HalfedgeId second = triangulation_.next(side);
      if (points_.turn(triangulation_.origin(side), triangulation_.target(side), triangulation_.target(second)) <= 0)
        continue;
      if (auto defect = defect_at(middle(side), segment, other)) return *std::move(defect);
    }
  }
  return places_.segment_name(segment) + " and " + places_.segment_name(other) + " bound no region";
}

}  // namespace

Result<std::optional<std::string>> polygon_defect(const Polygons& polygons, const Monitor& monitor) {
  const planar::PolygonPlaces places(polygons);
  if (auto defect = defect_of_cycles(polygons, places)) return defect;
  const PlanePoints points(polygons.corners, all_corners(polygons));
  A3D_ASSIGN(Subdivision triangulation, planar::delaunay(points, monitor));
  SegmentCheck check(polygons, places, points, triangulation);
  if (auto defect = check.defect_of_corners()) return defect;
  const std::vector<DirectedEdge> segments = planar::segments_of(polygons, planar::reversed_cycles(polygons));
  Stage stage(monitor, "checking segments", segments.size());
  for (const SegmentId segment : IdRange<SegmentId>(segments.size())) {
    if (!stage.begin_step()) return Monitor::interrupted();
    if (auto defect = check.insert(segment, segments[segment.index()])) return defect;
  }
  const auto conflict = planar::find_claim_conflict(triangulation, places.faces());
  if (!conflict) return Defect();
  return Defect(ConflictText(polygons, places, points, triangulation).text(*conflict));
}

Polygons oriented(const Polygons& polygons) {
  const std::vector<bool> is_reversed = planar::reversed_cycles(polygons);
  Polygons result;
  result.cycle_ends = polygons.cycle_ends;
  result.face_ends = polygons.face_ends;
  result.corners.reserve(polygons.corners.size());
  for (std::size_t cycle = 0; cycle < polygons.cycle_count(); ++cycle) {
    const std::uint32_t begin = polygons.first_corner(cycle), end = polygons.cycle_ends[cycle];
    if (begin != end) result.corners.push_back(polygons.corners[begin]);
    for (std::uint32_t i = begin + 1; i < end; ++i)
      result.corners.push_back(polygons.corners[is_reversed[cycle] ? begin + end - i : i]);
  }
  return result;
}

}  // namespace algebra3d
