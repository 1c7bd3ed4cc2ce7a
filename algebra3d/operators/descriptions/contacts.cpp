// clash, contactArea, commonVolume.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/box_solids.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/descriptions/detail/spatial_sets.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/measures/clash.h"
#include "algebra3d/values/measures/common_volume.h"
#include "algebra3d/values/measures/contact_area.h"
#include "algebra3d/values/spatial_relations/box_meshes.h"
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// The number of a triangle of a value, as by faces; the triangles of a box have none.
template <typename T>
std::optional<std::int64_t> triangle_number(FaceId face) {
  if (!std::is_same_v<T, Box3> && face.is_valid()) return std::int64_t{face.index()};
  return std::nullopt;
}

/// Nothing beyond the range of doubles.
std::optional<double> root_of(const Rational& squared) {
  const double root = squared.nearest_root();
  return std::isfinite(root) ? std::optional(root) : std::nullopt;
}

// ---- clash

using ClashRow = std::tuple<std::string, std::optional<double>, std::optional<double>, Point3d,
                            std::optional<std::int64_t>, std::optional<std::int64_t>>;

/// True if the boxes are clearly farther apart than the clearance.
bool are_clear(const Box3& a, const Box3& b, double clearance) {
  constexpr double kMargin = 0x1p-40;  // for the rounding of sums of squares
  return !a.intersects(b) && distance(a, b) * (1 - kMargin) > std::max(clearance, 0.0);
}

template <typename A, typename B>
Result<Maybe<std::optional<ClashRow>>> clash_row(Context& context, const OnDemand<A>& a, const OnDemand<B>& b,
                                                 double clearance) {
  using Row = std::optional<ClashRow>;
  const Box3 first_box = a.header().box, second_box = b.header().box;
  if (first_box.is_empty() || second_box.is_empty() || are_clear(first_box, second_box, clearance)) return Maybe(Row());
  A3D_ASSIGN(const A first, a.load());
  A3D_ASSIGN(const B second, b.load());
  const Maybe<Volume3d> first_solid = solid_of(first), second_solid = solid_of(second);
  if (!first_solid) return Maybe<Row>(Undefined{first_solid.reason()});
  if (!second_solid) return Maybe<Row>(Undefined{second_solid.reason()});
  A3D_ASSIGN(const std::optional<Clash> clash,
             clash_of(*first_solid, *second_solid, Rational(clearance), context.monitor()));
  if (!clash) return Maybe(Row());
  return Maybe(Row(ClashRow(std::string(name_of(clash->kind)),
                            clash->squared_depth ? root_of(*clash->squared_depth) : std::nullopt,
                            root_of(clash->squared_distance), Point3d{clash->point},
                            triangle_number<A>(clash->first_face), triangle_number<B>(clash->second_face))));
}

template <typename A, typename B>
Overload clash_overload() {
  return table<&clash_row<A, B>>({"Kind", "Depth", "Distance", "Point", "FirstTriangle", "SecondTriangle"}, "a", "b",
                                 "clearance");
}

void register_clash(OperatorGroup& group) {
  group.add({
      .name = "clash",
      .syntax = "clash(_, _, _)",
      .doc = "Whether and how two solids clash, in one row (Kind: string, Depth: real, Distance: real, Point: point3d, "
             "FirstTriangle: int, SecondTriangle: int); no row if they do not meet and are at least a clearance apart.",
      .detail =
          "Kind is the first that holds of: duplication, they are equal; envelopment, one is inside the other; "
          "piercing, they overlap, and one divides a body of the other; protrusion, they overlap; "
          "touching, they meet, but their interiors do not; clearance, their distance is less than the "
          "clearance. Kinds are decided exactly. Depth, of the second to the fourth kind, is the largest distance of a "
          "boundary point of one that lies inside the other from the other's boundary: no shift of one solid by less "
          "ends the clash. It may be too small by a billionth of it and 2^-44 of the largest coordinate. Point is the "
          "deepest point; of a duplication and of touching solids a common point; of a violated clearance that of the "
          "first solid nearest to the second. The triangles, numbered from 0 as by faces, are one that holds the "
          "point, and one "
          "nearest to it. Distance is that of the solids, rounded once. Boxes are solids; undefined for flat ones.",
      .exactness = Exactness::bounded,
      .sources = {"guthe2005", "tang2009"},
      .overloads = {clash_overload<Volume3d, Volume3d>(), clash_overload<Volume3d, Box3>(),
                    clash_overload<Box3, Volume3d>(), clash_overload<Box3, Box3>()},
      .examples = {{{kCubeOfTwo, "(rectangle3 1 5 1 5 1 5)", "0.0"},
                    R"((("protrusion" 1.0 0.0 (2.0 2.0 2.0) 2 undefined)))"},
                   {{kCubeOfTwo, kCubeOfTwo, "0.0"}, "1", "(count _)"},
                   {{"(rectangle3 4 5 5 6 0 1)", "(rectangle3 0 1 0 1 1 2)", "5.5"},
                    R"((("clearance" undefined 5.0 (4.0 5.0 1.0) undefined undefined)))"},
                   {{kUnitCube, "(rectangle3 3 4 0 1 0 1)", "2.0"}, "()"},
                   {{kUnitCube, "(rectangle3 0 1 0 1 0 0)", "2.0"}, "()"},
                   {{kUnitCube, kUndefinedSolid, "1.0"}, "()"}},
      .errors = {{{kUnitCube, kUnitCube}, "clash: expected (volume3d volume3d real)"}},
  });
}

// ---- contactArea

/// The triangles of a surface or of the boundary of a solid.
template <typename T>
T with_triangles(const T& value) {
  return value;
}
Surface3d with_triangles(const Box3& box) {
  if (dimension_of(box) < 2) return {};
  return dimension_of(box) == 2 ? surface_of_box(box) : Surface3d::trusted(solid_of_box(box).mesh());
}

template <typename A, typename B>
Result<double> contact_area_of(Context& context, const OnDemand<A>& a, const OnDemand<B>& b) {
  if (!a.header().box.intersects(b.header().box)) return 0.0;
  A3D_ASSIGN(const A first, a.load());
  A3D_ASSIGN(const B second, b.load());
  return contact_area(with_triangles(first).geometry(), with_triangles(second).geometry(), context.monitor());
}

struct ContactAreaMaker {
  template <typename A, typename B>
  static Overload make() {
    Overload made = overload<&contact_area_of<A, B>>("a", "b");
    made.is_symmetric = std::is_same_v<A, B>;
    return made;
  }
};

std::vector<Overload> contact_area_overloads() {
  std::vector<Overload> overloads;
  add_pairs<ContactAreaMaker, Volume3d, Surface3d, Box3>(overloads);
  return overloads;
}

void register_contact_area(OperatorGroup& group) {
  group.add({
      .name = "contactArea",
      .syntax = "contactArea(_, _)",
      .doc = "The area that two surfaces, or the boundaries of solids or boxes, have in common, in squared coordinate "
             "units.",
      .detail =
          "Of solids that touch it is the area of their contact; of solids that overlap, of all parts where faces "
          "lie upon each other, on whichever sides the insides are. Coplanar faces are found exactly. The area in "
          "each triangle of the first set has a relative error below 2^-100; the sum is rounded once. 0 if a set "
          "is empty.",
      .exactness = Exactness::two_ulp,
      .cost = Cost::linear,
      .overloads = contact_area_overloads(),
      .examples = {{{kCubeOfTwo, "(rectangle3 2 3 1 5 1 5)"}, "1.0"},
                   {{kCubeOfTwo, kCubeOfTwo}, "24.0"},
                   {{kCubeOfTwo, kInnerCube}, "0.0"},
                   {{kCubeOfTwo, "(surface3d (((0 0 2) (4 0 2) (0 4 2))))"}, "4.0"},
                   {{kCubeOfTwo, "(volume3d ())"}, "0.0"},
                   {{kCubeOfTwo, kUndefinedSolid}, "undefined"}},
      .errors = {{{kCubeOfTwo, "1"}, "contactArea: expected (volume3d volume3d)"}},
  });
}

// ---- commonVolume

double volume_of_box(const Box3& box) {
  if (box.is_empty()) return 0;
  Rational volume(1);
  for (std::size_t axis = 0; axis < 3; ++axis) volume *= Rational(box.max[axis]) - Rational(box.min[axis]);
  return volume.nearest_double();
}

template <typename A, typename B>
Result<double> common_volume_of(Context& context, const OnDemand<A>& a, const OnDemand<B>& b) {
  const Box3 first_box = a.header().box, second_box = b.header().box;
  if constexpr (std::is_same_v<A, Box3> && std::is_same_v<B, Box3>)
    return volume_of_box(intersect(first_box, second_box));
  if (!first_box.intersects(second_box)) return 0.0;
  A3D_ASSIGN(const A first, a.load());
  A3D_ASSIGN(const B second, b.load());
  const Maybe<Volume3d> first_solid = solid_of(first), second_solid = solid_of(second);
  if (!first_solid || !second_solid) return 0.0;  // flat boxes
  A3D_ASSIGN(const Rational volume, common_volume(*first_solid, *second_solid, context.monitor()));
  return volume.nearest_double();
}

struct CommonVolumeMaker {
  template <typename A, typename B>
  static Overload make() {
    Overload made = overload<&common_volume_of<A, B>>("a", "b");
    made.is_symmetric = std::is_same_v<A, B>;
    return made;
  }
};

std::vector<Overload> common_volume_overloads() {
  std::vector<Overload> overloads;
  add_pairs<CommonVolumeMaker, Volume3d, Box3>(overloads);
  return overloads;
}

void register_common_volume(OperatorGroup& group) {
  group.add({
      .name = "commonVolume",
      .syntax = "commonVolume(_, _)",
      .doc = "The volume that two solids or boxes have in common, in cubed coordinate units.",
      .detail =
          "That of their intersection, which is not made if they do not overlap, or one is inside the other. 0 if "
          "they only touch, or one is empty.",
      .exactness = Exactness::rounded_once,
      .sources = {"lien1984"},
      .overloads = common_volume_overloads(),
      .examples = {{{kCubeOfTwo, kInnerCube}, "1.0"},
                   {{kCubeOfTwo, "(rectangle3 1 5 1 5 1.5 5)"}, "0.5"},
                   {{"(rectangle3 0 4 0 4 0 4)", "(rectangle3 1 2 1 2 3 9)"}, "1.0"},
                   {{kUnitCube, "(rectangle3 1 2 0 1 0 1)"}, "0.0"},
                   {{kCubeOfTwo, "(volume3d ())"}, "0.0"},
                   {{kCubeOfTwo, kUndefinedSolid}, "undefined"}},
      .errors = {{{kCubeOfTwo, "1"}, "commonVolume: expected (volume3d volume3d)"}},
  });
}

}  // namespace

void register_contacts(OperatorGroup& group) {
  register_clash(group);
  register_contact_area(group);
  register_common_volume(group);
}

}  // namespace algebra3d
