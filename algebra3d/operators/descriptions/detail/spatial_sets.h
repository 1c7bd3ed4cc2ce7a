#pragma once

#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/constructions/region_meshes.h"
#include "algebra3d/values/spatial_relations/block_relations.h"
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

/// The kinds of sets that may be asked beside a surface or solid in blocks.
template <typename T>
inline constexpr bool kGoesWithBlocks =
    std::is_same_v<T, Box3> || std::is_same_v<T, Point3d> || std::is_same_v<T, Points3d> ||
    std::is_same_v<T, Surface3d> || std::is_same_v<T, Volume3d>;

/// The operand for a set with these blocks; a set without is loaded into `loaded`.
template <typename T>
Result<BlockedSet> blocked_set(Context& context, const OnDemand<T>& given, const FaceBlocks* blocks,
                               std::optional<T>& loaded) {
  if (blocks != nullptr) return BlockedSet(*blocks, std::is_same_v<T, Volume3d>);
  A3D_ASSIGN(T content, given.load());
  loaded = std::move(content);
  A3D_ASSIGN(SpatialSet set, set_of(*loaded, context));
  return BlockedSet(std::move(set), given.header().box);
}

/// Calls ask(a, b), which returns an optional answer, if a set has face blocks; nothing if none has.
template <typename A, typename B, typename Ask>
auto ask_by_blocks(Context& context, const OnDemand<A>& a, const OnDemand<B>& b, const Ask& ask)
    -> decltype(ask(std::declval<BlockedSet>(), std::declval<BlockedSet>())) {
  using Answer = decltype(ask(std::declval<BlockedSet>(), std::declval<BlockedSet>()));
  if constexpr (kGoesWithBlocks<A> && kGoesWithBlocks<B>) {
    A3D_ASSIGN(const auto blocks_of_a, a.face_blocks());
    A3D_ASSIGN(const auto blocks_of_b, b.face_blocks());
    if (blocks_of_a != nullptr || blocks_of_b != nullptr) {
      std::optional<A> loaded_a;
      std::optional<B> loaded_b;
      A3D_ASSIGN(const BlockedSet first, blocked_set(context, a, blocks_of_a.get(), loaded_a));
      A3D_ASSIGN(const BlockedSet second, blocked_set(context, b, blocks_of_b.get(), loaded_b));
      return ask(first, second);
    }
  }
  return Answer(typename Answer::value_type());
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
