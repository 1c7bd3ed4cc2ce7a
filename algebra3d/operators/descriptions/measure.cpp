// volume, volumeExact, area, centroid.
#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "algebra3d/kernel/planar/polygon_measures.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/planar.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

Result<double> volume_of(Context& context, const Volume3d& solid) {
  return nearest_volume(solid.mesh().points(), triangles_of(solid.mesh()), context.cancel);
}

Result<Text> volume_text(Context& context, const Volume3d& solid) {
  A3D_ASSIGN(const Rational volume, exact_volume(solid.mesh().points(), triangles_of(solid.mesh()), context.cancel));
  return Text{volume.text()};
}

template <typename T>
Result<double> area_of(Context& context, const T& geometry) {
  return nearest_area(geometry.mesh().points(), triangles_of(geometry.mesh()), context.cancel);
}

double area_of_region(const Region& region) {
  return nearest_area(region.polygons());
}

Result<Maybe<Point3d>> centroid_of(Context& context, const Volume3d& solid) {
  if (solid.mesh().is_empty()) return Maybe<Point3d>(Undefined{"an empty solid has no centroid"});
  // A valid solid that is not empty has a positive volume, and its centroid lies in its box.
  A3D_ASSIGN(const Vec3 centroid, nearest_centroid(solid.mesh().points(), triangles_of(solid.mesh()), context.cancel));
  return Maybe<Point3d>(Point3d{ExactPoint(centroid)});
}

// Three and four long at the right angle, five high: 1/6 * 3 * 4 * 5.
const std::string kCorner =
    "(volume3d (((0 0 0) (0 4 0) (3 0 0)) ((0 0 0) (3 0 0) (0 0 5)) ((0 0 0) (0 0 5) (0 4 0)) ((3 0 0) (0 4 0) (0 0 "
    "5))))";
const std::string kTriangle = "(surface3d (((0 0 0) (3 0 0) (0 4 0))))";

}  // namespace

void register_measure(OperatorGroup& group) {
  group.add({
      .name = "volume",
      .syntax = "volume(_)",
      .doc = "The enclosed volume of a solid, in cubed coordinate units.",
      .detail = "Cavities do not count. The empty solid has volume 0.",
      .exactness = Exactness::rounded_once,
      .sources = {"lien1984"},
      .overloads = {overload<&volume_of>("solid")},
      .examples = {{{kCubeOfTwo}, "8.0"},
                   {{"(createCube (makePoint3D 1e9 0 0) (makePoint3D 1000000002 2 2))"}, "8.0"},
                   {{kCorner}, "10.0"},
                   {{"(volume3d ())"}, "0.0"},
                   {{kUndefinedSolid}, "undefined"}},
      .errors = {{{kTriangle}, "volume: expected (volume3d), got (surface3d)"}},
  });
  group.add({
      .name = "volumeExact",
      .syntax = "volumeExact(_)",
      .doc = "The enclosed volume of a solid as a fraction in lowest terms, p or p/q, in cubed coordinate units.",
      .exactness = Exactness::exact,
      .sources = {"lien1984"},
      .overloads = {overload<&volume_text>("solid")},
      .examples = {{{kCubeOfTwo}, "'8'"},
                   {{"(createCube (makePoint3D 0 0 0) (makePoint3D 0.5 0.5 3))"}, "'3/4'"},
                   {{kUndefinedSolid}, "undefined"}},
      .errors = {{{kTriangle}, "volumeExact: expected (volume3d), got (surface3d)"}},
  });
  group.add({
      .name = "area",
      .syntax = "area(_)",
      .doc = "The area of a region, or of all triangles of a surface or solid, in squared coordinate units.",
      .detail =
          "Exact, rounded once, for regions, and if the area of every triangle is a double. Boundaries of cavities "
          "are included.",
      .exactness = Exactness::two_ulp,
      .overloads = {overload<&area_of<Surface3d>>("surface"), overload<&area_of<Volume3d>>("solid"),
                    overload<&area_of_region>("region")},
      .examples = {{{kCubeOfTwo}, "24.0"},
                   {{kTriangle}, "6.0"},
                   {{"(region ((((0 0) (3 0) (0 4)))))"}, "6.0"},
                   {{"(surface3d ())"}, "0.0"},
                   {{kUndefinedSolid}, "undefined"}},
      .errors = {{{"(makePoint3D 0 0 0)"}, "area: expected (surface3d), (volume3d) or (region), got (point3d)"}},
  });
  group.add({
      .name = "centroid",
      .syntax = "centroid(_)",
      .doc = "The centre of mass of a solid of uniform density.",
      .detail = "Each coordinate is the exact one, rounded once. Undefined for the empty solid.",
      .exactness = Exactness::rounded_once,
      .sources = {"lien1984"},
      .overloads = {overload<&centroid_of>("solid")},
      .examples = {{{kCubeOfTwo}, "(1.0 1.0 1.0)"},
                   {{kCorner}, "(0.75 1.0 1.25)"},
                   {{"(volume3d ())"}, "undefined"},
                   {{kUndefinedSolid}, "undefined"}},
      .errors = {{{kTriangle}, "centroid: expected (volume3d), got (surface3d)"}},
  });
}

}  // namespace algebra3d
