// makePoint, rectangle2, rect2region, perimeter, areaExact, faceCount, holeCount; region2surface, region2volume, slice,
// projectXY: regions, and the ways between the plane and space.
#include <utility>

#include "algebra3d/kernel/planar/polygon_measures.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/constructions/region_meshes.h"
#include "algebra3d/values/constructions/solid_sets.h"
#include "algebra3d/values/types/planar.h"
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

Point2d make_planar_point(double x, double y) {
  return {ExactPoint(Vec3{x, y, 0})};
}

Maybe<Rect> make_rect(double min_x, double max_x, double min_y, double max_y) {
  if (min_x > max_x || min_y > max_y) return Undefined{"a minimum is above its maximum"};
  return Rect{min_x, max_x, min_y, max_y};
}

Maybe<Region> region_of_rect(const Rect& rect) {
  if (rect.min_x == rect.max_x || rect.min_y == rect.max_y) return Undefined{"the rectangle is flat"};
  Polygons polygons;
  polygons.corners = PointArray({{rect.min_x, rect.min_y, 0},
                                 {rect.max_x, rect.min_y, 0},
                                 {rect.max_x, rect.max_y, 0},
                                 {rect.min_x, rect.max_y, 0}});
  polygons.cycle_ends = {4};
  polygons.face_ends = {1};
  return Region::trusted(std::move(polygons));
}

Text exact_area_text(const Region& region) {
  return {(doubled_area(region.polygons()) / Rational(2)).text()};
}

double perimeter_of(const Region& region) {
  return nearest_perimeter(region.polygons());
}

std::int64_t face_count_of(const Region& region) {
  return static_cast<std::int64_t>(region.polygons().face_count());
}
std::int64_t hole_count_of(const Region& region) {
  return static_cast<std::int64_t>(region.polygons().cycle_count() - region.polygons().face_count());
}

Result<Surface3d> surface_of(Context& context, const Region& region) {
  A3D_ASSIGN(TriangleMesh mesh, flat_mesh(region, context.monitor()));
  return Surface3d::trusted(std::move(mesh));
}

Result<Maybe<Volume3d>> prism_of(Context& context, const Region& region, double height) {
  if (height == 0) return Maybe<Volume3d>(Undefined{"the height is 0"});
  A3D_ASSIGN(TriangleMesh mesh, prism(region, height, context.monitor()));
  return Maybe<Volume3d>(Volume3d::trusted(std::move(mesh)));
}

Result<Region> slice_of(Context& context, const Volume3d& solid, double height) {
  const auto plane = ExactPlane::through(RationalVec3(Vec3{0, 0, height}), RationalVec3(Vec3{0, 0, 1}));
  A3D_ASSIGN(const Surface3d cut, section(context, solid, *plane));
  return covered_region(cut.mesh(), context.monitor());
}

Result<Region> shadow_of_solid(Context& context, const Volume3d& solid) {
  return shadow(solid.mesh(), context.monitor());
}

const std::string kSquareRegion = "(region ((((0 0) (4 0) (4 4) (0 4)))))";
const std::string kFrame = "(region ((((0 0) (4 0) (4 4) (0 4)) ((1 1) (3 1) (3 3) (1 3)))))";
const std::string kUndefinedRegion = "(region undefined)";

void register_making(OperatorGroup& group) {
  group.add({
      .name = "makePoint",
      .syntax = "makePoint(_, _)",
      .doc = "The point of the plane with these coordinates.",
      .exactness = Exactness::exact,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&make_planar_point>("x", "y")},
      .examples = {{{"1", "2.5"}, "(1.0 2.5)"}, {{"1", "(real undefined)"}, "undefined"}},
      .errors = {{{"1"}, "makePoint: expected (real real), got (int)"}},
  });
  group.add({
      .name = "rectangle2",
      .syntax = "rectangle2(_, _, _, _)",
      .doc = "The rectangle with the given minimum and maximum of x and of y.",
      .detail = "Undefined if a minimum is above its maximum.",
      .exactness = Exactness::exact,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&make_rect>("minX", "maxX", "minY", "maxY")},
      .examples = {{{"0", "1", "2", "4.5"}, "(0.0 1.0 2.0 4.5)"},
                   {{"1", "0", "2", "4"}, "undefined"},
                   {{"1", "(real undefined)", "2", "4"}, "undefined"}},
      .errors = {{{"1", "2"}, "rectangle2: expected (real real real real), got (int int)"}},
  });
  group.add({
      .name = "rect2region",
      .syntax = "_ rect2region",
      .also_prefix = true,
      .doc = "The rectangle as a region of one face.",
      .detail = "Undefined if the rectangle is flat.",
      .exactness = Exactness::exact,
      .overloads = {overload<&region_of_rect>("rectangle")},
      .examples = {{{"(rectangle2 0 1 2 4)"}, "((((0.0 2.0) (1.0 2.0) (1.0 4.0) (0.0 4.0))))"},
                   {{"(rectangle2 0 1 2 4)"}, "((((0.0 2.0) (1.0 2.0) (1.0 4.0) (0.0 4.0))))"},
                   {{"(rectangle2 0 0 2 4)"}, "undefined"},
                   {{"(rect undefined)"}, "undefined"}},
      .errors = {{{"1"}, "rect2region: expected (rect), got (int)"}},
  });
}

void register_measures(OperatorGroup& group) {
  group.add({
      .name = "areaExact",
      .syntax = "areaExact(_)",
      .doc = "The area of a region as a fraction in lowest terms, p or p/q, in squared coordinate units.",
      .exactness = Exactness::exact,
      .overloads = {overload<&exact_area_text>("region")},
      .examples = {{{kFrame}, "'12'"}, {{kUndefinedRegion}, "undefined"}},
      .errors = {{{"1"}, "areaExact: expected (region), got (int)"}},
  });
  group.add({
      .name = "perimeter",
      .syntax = "perimeter(_)",
      .doc = "The length of all boundary segments of a region, those of holes included, in coordinate units.",
      .exactness = Exactness::two_ulp,
      .overloads = {overload<&perimeter_of>("region")},
      .examples = {{{kFrame}, "24.0"}, {{kUndefinedRegion}, "undefined"}},
      .errors = {{{"1"}, "perimeter: expected (region), got (int)"}},
  });
  group.add({
      .name = "faceCount",
      .syntax = "faceCount(_)",
      .doc = "The number of faces of a region.",
      .detail = "It depends on the representation: equal regions may be divided into faces and holes differently "
                "where these touch in points.",
      .exactness = Exactness::exact,
      .overloads = {overload<&face_count_of>("region")},
      .examples = {{{kFrame}, "1"}, {{"(region ())"}, "0"}, {{kUndefinedRegion}, "undefined"}},
      .errors = {{{"1"}, "faceCount: expected (region), got (int)"}},
  });
  group.add({
      .name = "holeCount",
      .syntax = "holeCount(_)",
      .doc = "The number of holes in all faces of a region.",
      .detail = "It depends on the representation, see `faceCount`.",
      .exactness = Exactness::exact,
      .overloads = {overload<&hole_count_of>("region")},
      .examples = {{{kFrame}, "1"}, {{kUndefinedRegion}, "undefined"}},
      .errors = {{{"1"}, "holeCount: expected (region), got (int)"}},
  });
}

void register_ways_to_space(OperatorGroup& group) {
  group.add({
      .name = "region2surface",
      .syntax = "region2surface(_)",
      .doc = "The region as a surface at z = 0, with normals upward.",
      .detail =
          "Each face becomes a constrained Delaunay triangulation, without the holes. All corners are corners of the "
          "region.",
      .exactness = Exactness::exact,
      .frame_use = FrameUse::coordinates,
      .sources = {"guibas1985", "dwyer1987", "anglada1997"},
      .overloads = {overload<&surface_of>("region")},
      .examples = {{{kFrame}, "12.0", "(area _)"},
                   {{kFrame}, "8", "(size _)"},
                   {{"(region ())"}, "0", "(size _)"},
                   {{kUndefinedRegion}, "undefined"}},
      .errors = {{{"1"}, "region2surface: expected (region), got (int)"}},
  });
  group.add({
      .name = "region2volume",
      .syntax = "region2volume(_, _)",
      .doc = "The prism over a region: from z = 0 to the height, which may be negative.",
      .detail = "Undefined if the height is 0.",
      .exactness = Exactness::exact,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&prism_of>("region", "height")},
      .examples = {{{kFrame, "2.5"}, "30.0", "(volume _)"},
                   {{kSquareRegion, "-2"}, "(0.0 4.0 0.0 4.0 -2.0 0.0)", "(bbox _)"},
                   {{kSquareRegion, "0"}, "undefined"},
                   {{kUndefinedRegion, "1"}, "undefined"}},
      .errors = {{{kSquareRegion}, "region2volume: expected (region real), got (region)"}},
  });
}

void register_ways_from_space(OperatorGroup& group) {
  group.add({
      .name = "slice",
      .syntax = "slice(_, _)",
      .doc = "The region in which the horizontal plane at a height cuts a solid.",
      .detail = "Faces of the solid in the plane are included, whether the solid lies above or below; single points "
                "and segments are not. Coordinates that are not doubles are kept as fractions.",
      .exactness = Exactness::exact,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&slice_of>("solid", "z")},
      .examples = {{{kCubeOfTwo, "1.5"}, "((((0.0 0.0) (2.0 0.0) (2.0 2.0) (0.0 2.0))))"},
                   {{"(region2volume " + kFrame + " 3)", "3"}, "TRUE", "(= _ " + kFrame + ")"},
                   {{kCubeOfTwo, "2.5"}, "()"},
                   {{kUndefinedSolid, "1"}, "undefined"}},
      .errors = {{{kCubeOfTwo}, "slice: expected (volume3d real), got (volume3d)"}},
  });
  group.add({
      .name = "projectXY",
      .syntax = "projectXY(_)",
      .doc = "The vertical projection of a solid to the plane z = 0.",
      .exactness = Exactness::exact,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&shadow_of_solid>("solid")},
      .examples = {{{kCubeOfTwo}, "((((0.0 0.0) (2.0 0.0) (2.0 2.0) (0.0 2.0))))"},
                   {{"(union " + kCubeOfTwo + " (createCube (makePoint3D 1 1 5) (makePoint3D 3 3 6)))"},
                    "7.0",
                    "(area _)"},
                   {{kUndefinedSolid}, "undefined"}},
      .errors = {{{"1"}, "projectXY: expected (volume3d), got (int)"}},
  });
}

}  // namespace

void register_regions(OperatorGroup& group) {
  register_making(group);
  register_measures(group);
  register_ways_to_space(group);
  register_ways_from_space(group);
}

}  // namespace algebra3d
