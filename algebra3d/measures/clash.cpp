#include "algebra3d/measures/clash.h"

#include <array>
#include <utility>
#include <vector>

#include "algebra3d/distance/farthest_point.h"
#include "algebra3d/measures/detail/division.h"
#include "algebra3d/spatial_relations/nearest_points.h"
#include "algebra3d/spatial_relations/point_location.h"
#include "algebra3d/spatial_relations/relation.h"

namespace algebra3d {
namespace {

using FoundClash = std::optional<Clash>;

FarthestSearch depth_search(const Volume3d& of, const Volume3d& within) {
  const Geometry &from = of.geometry(), &to = within.geometry();
  return {{&from.mesh, &from.hierarchy()},
          {&to.mesh, &to.hierarchy()},
          [&to](const PointRef& point) { return place_in_solid(point, to) == Placement::inside; }};
}

/// A clash with the depth that the first search, from a into b, and perhaps the second find.
Result<FoundClash> with_depth(ClashKind kind, std::span<const FarthestSearch> searches, bool is_first_inside,
                              const Volume3d& a, const Volume3d& b, const Monitor& monitor) {
  ALGEBRA3D_ASSIGN_OR_RETURN(std::optional<FarthestPoint> deepest, farthest_point(searches, monitor));
  if (deepest) {
    const bool is_of_first = (deepest->search == 0) == is_first_inside;
    return FoundClash(Clash{kind, std::move(deepest->squared_distance), 0, std::move(deepest->point),
                            is_of_first ? deepest->face : deepest->nearest,
                            is_of_first ? deepest->nearest : deepest->face});
  }
  // No boundary point of one is inside the other: they have whole bodies in common, or all of a boundary.
  ALGEBRA3D_ASSIGN_OR_RETURN(const std::optional<MeetingWitness> witness, witness_of_meeting(a, b, monitor));
  return FoundClash(Clash{kind, Rational(0), 0, witness->point, witness->first_face, witness->second_face});
}

Result<FoundClash> envelopment(const Volume3d& a, const Volume3d& b, bool is_first_inside, const Monitor& monitor) {
  const FarthestSearch search = is_first_inside ? depth_search(a, b) : depth_search(b, a);
  return with_depth(ClashKind::envelopment, {&search, 1}, is_first_inside, a, b, monitor);
}

Result<FoundClash> overlap(const Volume3d& a, const Volume3d& b, const Monitor& monitor) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_divided, do_divide(a, b, monitor));
  const std::array<FarthestSearch, 2> searches{depth_search(a, b), depth_search(b, a)};
  return with_depth(is_divided ? ClashKind::piercing : ClashKind::protrusion, searches, true, a, b, monitor);
}

Result<FoundClash> meeting(ClashKind kind, const Volume3d& a, const Volume3d& b, const Monitor& monitor) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const std::optional<MeetingWitness> witness, witness_of_meeting(a, b, monitor));
  return FoundClash(Clash{kind, std::nullopt, 0, witness->point, witness->first_face, witness->second_face});
}

Result<FoundClash> violated_clearance(const Volume3d& a, const Volume3d& b, const Rational& clearance,
                                      const Monitor& monitor) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_near, are_within(a, b, clearance, monitor));
  if (!is_near) return FoundClash();
  const Geometry &first = a.geometry(), &second = b.geometry();
  ALGEBRA3D_ASSIGN_OR_RETURN(std::optional<ClosestPoints> closest,
                             closest_points({&first.mesh, &first.hierarchy()}, {&second.mesh, &second.hierarchy()},
                                            monitor));
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
  ALGEBRA3D_ASSIGN_OR_RETURN(const SpatialRelation relation, relation_of(a, b, monitor));
  if (!relation.do_meet) return violated_clearance(a, b, clearance, monitor);
  if (!relation.do_interiors_meet) return meeting(ClashKind::touching, a, b, monitor);
  if (relation.is_first_inside && relation.is_second_inside) return meeting(ClashKind::duplication, a, b, monitor);
  if (relation.is_first_inside || relation.is_second_inside)
    return envelopment(a, b, relation.is_first_inside, monitor);
  return overlap(a, b, monitor);
}

}  // namespace algebra3d
