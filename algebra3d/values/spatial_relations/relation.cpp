#include "algebra3d/values/spatial_relations/relation.h"

#include <array>
#include <concepts>
#include <utility>

#include "algebra3d/values/spatial_relations/box_meshes.h"
#include "algebra3d/values/spatial_relations/detail/box_relation.h"
#include "algebra3d/values/spatial_relations/detail/findings.h"
#include "algebra3d/values/spatial_relations/detail/mesh_relation.h"
#include "algebra3d/values/spatial_relations/detail/point_relation.h"
#include "algebra3d/values/spatial_relations/detail/segment_relation.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

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

Result<SpatialRelation> relation_of(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor) {
  Findings findings(Question::everything);
  A3D_ASSIGN(const Emptiness is_empty, find(a, b, findings, monitor));
  if (is_empty[0] || is_empty[1]) return SpatialRelation{false, false, is_empty[0], is_empty[1], -1, -1};
  return SpatialRelation{findings.do_meet(),
                         findings.do_interiors_meet(),
                         !findings.leaves(Role::first),
                         !findings.leaves(Role::second),
                         findings.shared_dimension(),
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
