#include "algebra3d/values/measures/clash.h"

#include <array>
#include <utility>
#include <vector>

#include "algebra3d/kernel/distance/farthest_point.h"
#include "algebra3d/values/measures/detail/overlap.h"
#include "algebra3d/values/spatial_relations/boundary_faces.h"
#include "algebra3d/values/spatial_relations/nearest_points.h"
#include "algebra3d/values/spatial_relations/relation.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using FoundClash = std::optional<Clash>;

DistanceOperand boundary_of(const Volume3d& solid) {
  return {&solid.mesh(), &solid.geometry().hierarchy()};
}

/// The triangle of a solid that is nearest to a point.
Result<FaceId> triangle_near(const ExactPoint& point, const Volume3d& solid, const Monitor& monitor) {
  const BoundaryFaces place(PointSet{{&point, 1}});
  A3D_ASSIGN(const auto closest, closest_points(place.operand(), boundary_of(solid), monitor));
  return closest->second_face;
}

/// A clash with its depth: that of the deepest point of parts of the boundaries that lie inside the other solid.
Result<FoundClash> with_depth(ClashKind kind, const Volume3d& a, const Volume3d& b, const Surface3d& of_a_in_b,
                              const Surface3d& of_b_in_a, const Monitor& monitor) {
  std::vector<FarthestSearch> searches;
  const auto add = [&](const Surface3d& part, const Volume3d& around) {
    if (!part.mesh().is_empty())
      searches.push_back({{&part.mesh(), &part.geometry().hierarchy()}, boundary_of(around)});
  };
  add(of_a_in_b, b);
  add(of_b_in_a, a);
  A3D_ASSIGN(std::optional<FarthestPoint> deepest, farthest_point(searches, monitor));
  if (!deepest) {
    // They have whole bodies in common.
    A3D_ASSIGN(const std::optional<MeetingWitness> witness, witness_of_meeting(a, b, monitor));
    return FoundClash(Clash{kind, Rational(0), 0, witness->point, witness->first_face, witness->second_face});
  }
  A3D_ASSIGN(const FaceId of_first, triangle_near(deepest->point, a, monitor));
  A3D_ASSIGN(const FaceId of_second, triangle_near(deepest->point, b, monitor));
  return FoundClash(
      Clash{kind, std::move(deepest->squared_distance), 0, std::move(deepest->point), of_first, of_second});
}

Result<FoundClash> envelopment(const Volume3d& a, const Volume3d& b, bool is_first_inside, const Monitor& monitor) {
  const Surface3d inner = Surface3d::trusted((is_first_inside ? a : b).mesh());
  return with_depth(ClashKind::envelopment, a, b, is_first_inside ? inner : Surface3d(),
                    is_first_inside ? Surface3d() : inner, monitor);
}

Result<FoundClash> overlap(const Volume3d& a, const Volume3d& b, const Monitor& monitor) {
  A3D_ASSIGN(const Overlap overlap, Overlap::of(a, b, monitor));
  return with_depth(overlap.is_divided ? ClashKind::piercing : ClashKind::protrusion, a, b, overlap.of_first_in_second,
                    overlap.of_second_in_first, monitor);
}

Result<FoundClash> meeting(ClashKind kind, const Volume3d& a, const Volume3d& b, const Monitor& monitor) {
  A3D_ASSIGN(const std::optional<MeetingWitness> witness, witness_of_meeting(a, b, monitor));
  return FoundClash(Clash{kind, std::nullopt, 0, witness->point, witness->first_face, witness->second_face});
}

Result<FoundClash> violated_clearance(const Volume3d& a, const Volume3d& b, const Rational& clearance,
                                      const Monitor& monitor) {
  A3D_ASSIGN(const bool is_near, are_within(a, b, clearance, monitor));
  if (!is_near) return FoundClash();
  const Geometry &first = a.geometry(), &second = b.geometry();
  A3D_ASSIGN(std::optional<ClosestPoints> closest,
             closest_points({&first.mesh, &first.hierarchy()}, {&second.mesh, &second.hierarchy()}, monitor));
  if (!closest || closest->squared_distance >= clearance * clearance) return FoundClash();
  return FoundClash(Clash{ClashKind::clearance, std::nullopt, std::move(closest->squared_distance),
                          std::move(closest->first), closest->first_face, closest->second_face});
}

}  // namespace

std::string_view name_of(ClashKind kind) {
  constexpr std::array<std::string_view, 6> kNames{"duplication", "envelopment", "piercing",
                                                   "protrusion",  "touching",    "clearance"};
  return kNames[static_cast<std::size_t>(kind)];
}

Result<std::optional<Clash>> clash_of(const Volume3d& a, const Volume3d& b, const Rational& clearance,
                                      const Monitor& monitor) {
  A3D_ASSIGN(const SpatialRelation relation, relation_of(a, b, monitor));
  if (!relation.do_meet) return violated_clearance(a, b, clearance, monitor);
  if (!relation.do_interiors_meet) return meeting(ClashKind::touching, a, b, monitor);
  if (relation.is_first_inside && relation.is_second_inside) return meeting(ClashKind::duplication, a, b, monitor);
  if (relation.is_first_inside || relation.is_second_inside)
    return envelopment(a, b, relation.is_first_inside, monitor);
  return overlap(a, b, monitor);
}

}  // namespace algebra3d
