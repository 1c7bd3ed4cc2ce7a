#include "algebra3d/values/spatial_relations/relation.h"

#include <algorithm>
#include <array>
#include <compare>
#include <concepts>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/values/spatial_relations/box_meshes.h"
#include "algebra3d/values/spatial_relations/detail/findings.h"
#include "algebra3d/values/spatial_relations/detail/mesh_relation.h"
#include "algebra3d/values/spatial_relations/detail/mesh_set.h"
#include "algebra3d/values/spatial_relations/detail/segment_relation.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// The box is not a point. Cost: linear.
void relate_points(const PointSet& points, const Box3& box, Role role, Findings& findings);
/// Cost: that of locating each point.
void relate_points(const PointSet& points, const MeshSet& mesh, Role role, Findings& findings, const Monitor& monitor);

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

// Relations of points with other sets. `role` is that of the points; nothing is empty.
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

bool is_flat(const Box3& box, std::size_t axis) {
  return box.min[axis] == box.max[axis];
}

/// True if the insides of the intervals meet; a single point is its own inside.
bool do_insides_meet(const Box3& a, const Box3& b, std::size_t axis) {
  if (is_flat(a, axis) && is_flat(b, axis)) return a.min[axis] == b.min[axis];
  return std::max(a.min[axis], b.min[axis]) < std::min(a.max[axis], b.max[axis]) ||
         (is_flat(a, axis) && b.min[axis] < a.min[axis] && a.min[axis] < b.max[axis]) ||
         (is_flat(b, axis) && a.min[axis] < b.min[axis] && b.min[axis] < a.max[axis]);
}

/// The parts of the boundary of a box: two for each axis along which it has an extent.
std::vector<Box3> sides_of(const Box3& box) {
  std::vector<Box3> result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (is_flat(box, axis)) continue;
    for (const double bound : {box.min[axis], box.max[axis]}) {
      Box3& side = result.emplace_back(box);
      side.min[axis] = side.max[axis] = bound;
    }
  }
  return result;
}

/// The relation of two boxes, axis by axis.
void relate_boxes(const Box3& first, const Box3& second, Findings& findings) {
  if (!second.contains(first)) findings.add_leaving(Role::first);
  if (!first.contains(second)) findings.add_leaving(Role::second);
  const Box3 common = intersect(first, second);
  if (common.is_empty()) return;
  const bool do_interiors_meet =
      do_insides_meet(first, second, 0) && do_insides_meet(first, second, 1) && do_insides_meet(first, second, 2);
  if (do_interiors_meet)
    findings.add_common_interior(dimension_of(common));
  else
    findings.add_common(dimension_of(common));
  if (findings.wants_witness()) findings.add_witness({ExactPoint(common.min), {}, {}});
  if (!findings.wants_boundaries()) return;
  for (const Box3& a : sides_of(first))
    for (const Box3& b : sides_of(second))
      if (a.intersects(b)) findings.add_common_boundary(dimension_of(intersect(a, b)));
}

bool is_empty(const PointSet& set) {
  return set.points.empty();
}

bool is_empty(const Box3& box) {
  return box.is_empty();
}

bool is_empty(const Surface3d& surface) {
  return surface.mesh().is_empty();
}

bool is_empty(const Volume3d& solid) {
  return solid.mesh().is_empty();
}

MeshSet mesh_set(const Surface3d& surface) {
  return {&surface.geometry(), false};
}

MeshSet mesh_set(const Volume3d& solid) {
  return {&solid.geometry(), true};
}

template <typename T>
concept MeshValue = std::same_as<T, Surface3d> || std::same_as<T, Volume3d>;

/// Relates two sets by their kinds. Has one order of two kinds; `role` is that of the first argument.
class PairRelation {
 public:
  PairRelation(Findings& findings, const Monitor& monitor) : findings_(findings), monitor_(monitor) {}

  void relate(const PointSet& a, const PointSet& b, Role /*role*/) { relate_points(a, b, findings_); }
  void relate(const PointSet& points, const Box3& box, Role role) {
    if (dimension_of(box) == 0) {
      const ExactPoint corner(box.min);
      return role == Role::first ? relate_points(points, PointSet{{&corner, 1}}, findings_)
                                 : relate_points(PointSet{{&corner, 1}}, points, findings_);
    }
    relate_points(points, box, role, findings_);
  }
  template <MeshValue Mesh>
  void relate(const PointSet& points, const Mesh& mesh, Role role) {
    relate_points(points, mesh_set(mesh), role, findings_, monitor_);
  }
  void relate(const Box3& a, const Box3& b, Role /*role*/) { relate_boxes(a, b, findings_); }
  template <MeshValue Mesh>
  void relate(const Box3& box, const Mesh& mesh, Role role) {
    switch (dimension_of(box)) {
      case 0: {
        const ExactPoint corner(box.min);
        return relate(PointSet{{&corner, 1}}, mesh, role);
      }
      case 1:
        return relate_segment(box, mesh_set(mesh), role, findings_, monitor_);
      case 2:
        return relate_in_order(mesh_set(surface_of_box(box)), mesh, role);
      default:
        return relate_in_order(mesh_set(solid_of_box(box)), mesh, role);
    }
  }
  template <MeshValue A, MeshValue B>
  void relate(const A& a, const B& b, Role role) {
    relate_in_order(mesh_set(a), b, role);
  }

 private:
  template <MeshValue Mesh>
  void relate_in_order(const MeshSet& a, const Mesh& mesh, Role role) {
    const MeshSet b = mesh_set(mesh);
    role == Role::first ? relate_meshes(a, b, findings_, monitor_) : relate_meshes(b, a, findings_, monitor_);
  }

  Findings& findings_;
  const Monitor& monitor_;
};

/// Whether the sets are empty.
using Emptiness = std::array<bool, 2>;

/// Nothing is found out about empty sets.
Result<Emptiness> find(const SpatialSet& a, const SpatialSet& b, Findings& findings, const Monitor& monitor) {
  const auto check = [](const auto& set) { return is_empty(set); };
  const Emptiness emptiness{std::visit(check, a), std::visit(check, b)};
  if (emptiness[0] || emptiness[1]) return emptiness;
  PairRelation pair(findings, monitor);
  std::visit(
      [&](const auto& first, const auto& second) {
        if constexpr (requires { pair.relate(first, second, Role::first); })
          pair.relate(first, second, Role::first);
        else
          pair.relate(second, first, Role::second);
      },
      a, b);
  A3D_TRY(monitor.check());
  return emptiness;
}

RelativePosition position_from(const Findings& findings, const Emptiness& is_empty) {
  if (is_empty[0] || is_empty[1]) return {false, false, is_empty[0], is_empty[1]};
  return {findings.do_meet(), findings.do_interiors_meet(), !findings.leaves(Role::first),
          !findings.leaves(Role::second)};
}

}  // namespace

Result<bool> do_meet(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor) {
  Findings findings(Question::meeting);
  A3D_TRY(find(a, b, findings, monitor));
  return findings.do_meet();
}

Result<bool> do_touch(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor) {
  Findings findings(Question::touching);
  A3D_TRY(find(a, b, findings, monitor));
  return findings.do_meet() && !findings.do_interiors_meet();
}

Result<bool> is_inside(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor) {
  Findings findings(Question::first_inside);
  A3D_ASSIGN(const Emptiness is_empty, find(a, b, findings, monitor));
  return is_empty[0] || (!is_empty[1] && !findings.leaves(Role::first));
}

Result<bool> do_overlap(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor) {
  Findings findings(Question::overlap);
  A3D_TRY(find(a, b, findings, monitor));
  return findings.do_interiors_meet() && findings.leaves(Role::first) && findings.leaves(Role::second);
}

// The search for an overlap ends when all four facts are true, or with every fact found.
Result<RelativePosition> position_of(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor) {
  Findings findings(Question::overlap);
  A3D_ASSIGN(const Emptiness is_empty, find(a, b, findings, monitor));
  return position_from(findings, is_empty);
}

Result<SpatialRelation> relation_of(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor) {
  Findings findings(Question::everything);
  A3D_ASSIGN(const Emptiness is_empty, find(a, b, findings, monitor));
  return SpatialRelation{position_from(findings, is_empty), findings.shared_dimension(),
                         findings.shared_boundary_dimension()};
}

Result<std::optional<MeetingWitness>> witness_of_meeting(const SpatialSet& a, const SpatialSet& b,
                                                         const Monitor& monitor) {
  Findings findings(Question::witness);
  A3D_TRY(find(a, b, findings, monitor));
  std::optional<MeetingWitness> witness = findings.witness();
  // The triangles of a box are not those of a value.
  if (witness && std::holds_alternative<Box3>(a)) witness->first_face = {};
  if (witness && std::holds_alternative<Box3>(b)) witness->second_face = {};
  return witness;
}

}  // namespace algebra3d
