#include "algebra3d/values/spatial_relations/detail/point_relation.h"

#include <compare>

#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d {
namespace {

/// Adds a point of the set that has the role, by where it is relative to the other set.
void add_point(const ExactPoint& point, Placement placement, Role role, Findings& findings) {
  if (placement == Placement::outside) return findings.add_leaving(role);
  if (findings.wants_witness()) findings.add_witness({point, {}, {}});
  if (placement == Placement::inside) return findings.add_common_interior(0);
  findings.add_common(0);
}

Placement place_in_box(PointRef point, const Box3& box) {
  Placement result = Placement::inside;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto to_min = compare(axis, point, PointRef(box.min)), to_max = compare(axis, point, PointRef(box.max));
    if (std::is_lt(to_min) || std::is_gt(to_max)) return Placement::outside;
    const bool is_flat = box.min[axis] == box.max[axis];
    if (!is_flat && (std::is_eq(to_min) || std::is_eq(to_max))) result = Placement::boundary;
  }
  return result;
}

}  // namespace

void relate_points(const PointSet& points, const PointSet& others, Findings& findings) {
  auto a = points.points.begin(), b = others.points.begin();
  while (a != points.points.end() && b != others.points.end() && !findings.is_complete()) {
    const auto order = *a <=> *b;
    if (std::is_eq(order)) add_point(*a, Placement::inside, Role::first, findings);
    if (std::is_lt(order)) findings.add_leaving(Role::first);
    if (std::is_gt(order)) findings.add_leaving(Role::second);
    if (std::is_lteq(order)) ++a;
    if (std::is_gteq(order)) ++b;
  }
  if (findings.is_complete()) return;
  if (a != points.points.end()) findings.add_leaving(Role::first);
  if (b != others.points.end()) findings.add_leaving(Role::second);
}

void relate_points(const PointSet& points, const Box3& box, Role role, Findings& findings) {
  findings.add_leaving(other(role));
  for (const ExactPoint& point : points.points) {
    if (findings.is_complete()) return;
    add_point(point, place_in_box(point, box), role, findings);
  }
}

void relate_points(const PointSet& points, const MeshSet& mesh, Role role, Findings& findings, const Monitor& monitor) {
  findings.add_leaving(other(role));
  std::size_t step = 0;
  for (const ExactPoint& point : points.points) {
    if (findings.is_complete() || (++step % 4096 == 0 && monitor.is_cancelled())) return;
    add_point(point, mesh.place(point), role, findings);
  }
}

}  // namespace algebra3d
