#pragma once

#include <utility>
#include <vector>

#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/constructions/region_meshes.h"
#include "algebra3d/values/spatial_relations/relation.h"
#include "algebra3d/values/types/planar.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"

// Operators on two sets of points, each of any kind.

namespace algebra3d {

// Values as sets of points. Those in the plane lie at z = 0.

inline Result<SpatialSet> set_of(const Box3& box, Context& /*context*/) {
  return SpatialSet(box);
}
inline Result<SpatialSet> set_of(const Point3d& point, Context& /*context*/) {
  return SpatialSet(PointSet{{&point.position, 1}});
}
inline Result<SpatialSet> set_of(const Points3d& points, Context& /*context*/) {
  return SpatialSet(PointSet{points.points()});
}
inline Result<SpatialSet> set_of(const Surface3d& surface, Context& /*context*/) {
  return SpatialSet(surface);
}
inline Result<SpatialSet> set_of(const Volume3d& solid, Context& /*context*/) {
  return SpatialSet(solid);
}
inline Result<SpatialSet> set_of(const Point2d& point, Context& /*context*/) {
  return SpatialSet(PointSet{{&point.position, 1}});
}
inline Result<SpatialSet> set_of(const Rect& rect, Context& /*context*/) {
  return SpatialSet(rect.box());
}
inline Result<SpatialSet> set_of(const Region& region, Context& context) {
  A3D_ASSIGN(TriangleMesh mesh, flat_mesh(region, context.monitor()));
  return SpatialSet(Surface3d::trusted(std::move(mesh)));
}

inline bool is_either_empty(const GeometryHeader& a, const GeometryHeader& b) {
  return a.box.is_empty() || b.box.is_empty();
}

/// Loads both and calls ask(a, b).
template <typename A, typename B, typename Ask>
auto ask_loaded(Context& context, const OnDemand<A>& a, const OnDemand<B>& b, const Ask& ask)
    -> decltype(ask(std::declval<SpatialSet>(), std::declval<SpatialSet>())) {
  A3D_ASSIGN(const A first, a.load());
  A3D_ASSIGN(const B second, b.load());
  A3D_ASSIGN(const SpatialSet first_set, set_of(first, context));
  A3D_ASSIGN(const SpatialSet second_set, set_of(second, context));
  return ask(first_set, second_set);
}

/// Adds the overloads Maker::make<First, Second>() for one kind and each of several.
template <typename Maker, typename First, typename... Seconds>
void add_row(std::vector<Overload>& overloads) {
  (overloads.push_back(Maker::template make<First, Seconds>()), ...);
}
/// Adds the overloads for all pairs of the kinds.
template <typename Maker, typename... Kinds>
void add_pairs(std::vector<Overload>& overloads) {
  (add_row<Maker, Kinds, Kinds...>(overloads), ...);
}
/// The overloads Maker::make<A, B>() for all pairs of kinds of sets in space.
template <typename Maker>
std::vector<Overload> pairs_in_space() {
  std::vector<Overload> overloads;
  add_pairs<Maker, Box3, Point3d, Points3d, Surface3d, Volume3d>(overloads);
  return overloads;
}
/// The overloads for all pairs of kinds of sets in space and for all pairs of kinds in the plane.
template <typename Maker>
std::vector<Overload> all_pairs() {
  std::vector<Overload> overloads = pairs_in_space<Maker>();
  add_pairs<Maker, Rect, Point2d, Region>(overloads);
  return overloads;
}

}  // namespace algebra3d
