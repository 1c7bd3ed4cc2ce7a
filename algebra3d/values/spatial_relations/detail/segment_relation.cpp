#include "algebra3d/values/spatial_relations/detail/segment_relation.h"

#include <algorithm>
#include <vector>

#include "algebra3d/kernel/exact/intersection_point.h"

namespace algebra3d {
namespace {

/// The places at which triangles may end along a segment that is parallel to an axis.
class SegmentCuts {
 public:
  explicit SegmentCuts(const Box3& segment) : begin_(segment.min), end_(segment.max), points_{begin_, end_} {}

  void add(const TriangleRef& triangle) {
    if (intersect_segment_triangle(begin_, end_, triangle) == Contact::none) return;
    const auto& [a, b, c] = triangle;
    const int begin_side = orient3d(a, b, c, begin_), end_side = orient3d(a, b, c, end_);
    // One that lies in the plane at its end meets it there, at a point that is known.
    if (begin_side != 0 && end_side != 0)
      points_.push_back(intersect_line_plane(begin_, end_, IntegerPlane::through(triangle)));
    if (begin_side != 0 || end_side != 0) return;
    for (std::size_t i = 0; i < 3; ++i) add_edge(triangle[i], triangle[(i + 1) % 3]);
  }

  /// All cuts and the ends, in order.
  std::vector<ExactPoint> sorted() && {
    std::ranges::sort(points_);
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    return std::move(points_);
  }

 private:
  /// An edge in a common plane with the segment.
  void add_edge(const PointRef& p, const PointRef& q) {
    for (const PointRef& corner : {p, q})
      if (is_on_segment(corner, begin_, end_)) points_.emplace_back(corner);
    if (intersect_segments(begin_, end_, p, q) != Contact::point) return;
    // The segment lies in a plane across another axis that is not parallel to the edge.
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (begin_.approx()[axis] != end_.approx()[axis] || std::is_eq(compare(axis, p, q))) continue;
      points_.push_back(intersect_line_plane(p, q, plane_across(axis)));
      return;
    }
  }

  IntegerPlane plane_across(std::size_t axis) const {
    std::array<Rational, 3> coordinates{Rational(0), Rational(0), Rational(0)};
    coordinates[axis] = Rational(1);
    return IntegerPlane::of(
        ExactPlane{RationalVec3(coordinates[0], coordinates[1], coordinates[2]), Rational(begin_.approx()[axis])});
  }

  ExactPoint begin_, end_;
  std::vector<ExactPoint> points_;
};

ExactPoint middle_of(const ExactPoint& p, const ExactPoint& q) {
  const RationalVec3 a = p.rational(), b = q.rational();
  const Rational half(1, 2);
  return ExactPoint(RationalVec3((a.x + b.x) * half, (a.y + b.y) * half, (a.z + b.z) * half));
}

}  // namespace

void relate_segment(const Box3& segment, const MeshSet& mesh, Role role, Findings& findings, const Monitor& monitor) {
  findings.add_leaving(other(role));
  SegmentCuts cuts(segment);
  mesh.geometry->hierarchy().for_each_meeting(segment, [&](auto face) {
    cuts.add(mesh.mesh().corners(FaceId(face)));
    return !monitor.is_cancelled();
  });
  const std::vector<ExactPoint> points = std::move(cuts).sorted();
  const auto add = [&](const ExactPoint& point, int dimension, bool is_end) {
    const Placement placement = mesh.place(point);
    if (placement == Placement::outside) return findings.add_leaving(role);
    if (findings.wants_witness()) findings.add_witness({point, {}, {}});
    findings.add_common(dimension);
    if (placement == Placement::inside && !is_end) findings.add_common_interior(dimension);
    if (placement == Placement::boundary && is_end) findings.add_common_boundary(0);
  };
  for (std::size_t i = 0; i < points.size() && !findings.is_complete(); ++i) {
    add(points[i], 0, i == 0 || i + 1 == points.size());
    if (i + 1 < points.size()) add(middle_of(points[i], points[i + 1]), 1, false);
  }
}

}  // namespace algebra3d
