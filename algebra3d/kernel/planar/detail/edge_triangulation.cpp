#include "algebra3d/kernel/planar/detail/edge_triangulation.h"

#include "algebra3d/kernel/planar/detail/delaunay.h"
#include "algebra3d/kernel/planar/segment_text.h"
#include "base/propagate.h"

namespace algebra3d::planar {

std::string EdgeTriangulation::text_of(SegmentId edge) const {
  const auto& [from, to] = edges_[edge];
  return segment_text(points_[points_.vertex_of(from)], points_[points_.vertex_of(to)]);
}

Status EdgeTriangulation::insert(SegmentId edge, ConstraintInserter& inserter) {
  const VertexId from = points_.vertex_of(edges_[edge].first), to = points_.vertex_of(edges_[edge].second);
  if (from == to) return {};
  if (!inserter.insert(from, to)) {
    const SegmentId other = segment_of_mark(triangulation_.mark(inserter.crossing()));
    return Error{ErrorCode::invalid_value, "segment {} crosses segment {}", text_of(edge), text_of(other)};
  }
  for (const HalfedgeId h : inserter.along()) {
    const std::uint32_t mark = triangulation_.mark(h);
    if (!mark_segment(triangulation_, h, edge))
      return Error{ErrorCode::invalid_value, "segment {} overlaps segment {}", text_of(edge),
                   text_of(segment_of_mark(mark))};
  }
  return {};
}

Status EdgeTriangulation::build(const Monitor& monitor) {
  A3D_ASSIGN(triangulation_, delaunay(points_, monitor));
  Stage stage(monitor, "triangulating", edges_.size());
  ConstraintInserter inserter(points_, triangulation_);
  for (const SegmentId edge : IdRange<SegmentId>(edges_.size())) {
    if (!stage.begin_step()) return Monitor::interrupted();
    A3D_TRY(insert(edge, inserter));
  }
  return {};
}

Status EdgeTriangulation::check_one_direction() const {
  const Subdivision& t = triangulation_;
  for (const HalfedgeId h : t.halfedges())
    if (!t.is_taken_out(h) && mark_has_inside(t.mark(h)) && mark_has_inside(t.mark(Subdivision::twin(h))))
      return Error{ErrorCode::invalid_value, "segment {} is given in both directions",
                   segment_text(points_[t.origin(h)], points_[t.target(h)])};
  return {};
}

Result<InsideTriangles> EdgeTriangulation::find_inside() const {
  InsideTriangles found = planar::find_inside(triangulation_);
  if (found.wrong_halfedge) {
    const HalfedgeId h = *found.wrong_halfedge;
    return Error{ErrorCode::invalid_value, "the segments bound no region: the inside meets the outside at {}",
                 segment_text(points_[triangulation_.origin(h)], points_[triangulation_.target(h)])};
  }
  return found;
}

}  // namespace algebra3d::planar
