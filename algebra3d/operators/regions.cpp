// makePoint, rectangle2, rect2region, perimeter, areaExact, faceCount, holeCount; region2surface, region2volume, slice,
// projectXY: regions, and the ways between the plane and space.
#include <utility>

#include "algebra3d/operators/all.h"
#include "algebra3d/operators/region_meshes.h"
#include "algebra3d/operators/sample_values.h"
#include "algebra3d/operators/solid_sets.h"
#include "algebra3d/planar/polygon_measures.h"
#include "algebra3d/registry/overload.h"
#include "algebra3d/types/planar.h"
#include "algebra3d/types/scalars.h"

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
  ASSIGN_OR_RETURN(TriangleMesh mesh, flat_mesh(region, context.monitor()));
  return Surface3d::trusted(std::move(mesh));
}

Result<Maybe<Volume3d>> prism_of(Context& context, const Region& region, double height) {
  if (height == 0) return Maybe<Volume3d>(Undefined{"the height is 0"});
  ASSIGN_OR_RETURN(TriangleMesh mesh, prism(region, height, context.monitor()));
  return Maybe<Volume3d>(Volume3d::trusted(std::move(mesh)));
}

Result<Region> slice_of(Context& context, const Volume3d& solid, double height) {
  const auto plane = ExactPlane::through(RationalVec3(Vec3{0, 0, height}), RationalVec3(Vec3{0, 0, 1}));
  ASSIGN_OR_RETURN(const Surface3d cut, section(context, solid, *plane));
  return covered_region(cut.mesh(), context.monitor());
}

Result<Region> shadow_of_solid(Context& context, const Volume3d& solid) {
  return shadow(solid.mesh(), context.monitor());
}

const std::string kSquareRegion = "[const region value ((((0 0) (4 0) (4 4) (0 4))))]";
const std::string kFrame = "[const region value ((((0 0) (4 0) (4 4) (0 4)) ((1 1) (3 1) (3 3) (1 3))))]";
const std::string kUndefinedRegion = "[const region value undefined]";

void register_making(Registry& registry) {
  registry.add({
      .name = "makePoint",
      .syntax = "makePoint(_, _)",
      .doc = "The point of the plane with these coordinates.",
      .exactness = Exactness::exact,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&make_planar_point>("x", "y")},
      .examples = {{"makePoint(1, 2.5)", "(1.0 2.5)"}, {"makePoint(1, [const real value undefined])", "undefined"}},
      .errors = {{"query makePoint(1)", "makePoint: expected (real real), got (int)"}},
  });
  registry.add({
      .name = "rectangle2",
      .syntax = "rectangle2(_, _, _, _)",
      .doc = "The rectangle with these sides: minimum and maximum of x, of y.",
      .detail = "Undefined if a minimum is above its maximum.",
      .exactness = Exactness::exact,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&make_rect>("minX", "maxX", "minY", "maxY")},
      .examples = {{"rectangle2(0, 1, 2, 4.5)", "(0.0 1.0 2.0 4.5)"},
                   {"rectangle2(1, 0, 2, 4)", "undefined"},
                   {"rectangle2(1, [const real value undefined], 2, 4)", "undefined"}},
      .errors = {{"query rectangle2(1, 2)", "rectangle2: expected (real real real real), got (int int)"}},
  });
  registry.add({
      .name = "rect2region",
      .syntax = "_ rect2region",
      .also_prefix = true,
      .doc = "The rectangle as a region of one face.",
      .detail = "Undefined if the rectangle is flat.",
      .exactness = Exactness::exact,
      .overloads = {overload<&region_of_rect>("rectangle")},
      .examples = {{"rect2region(rectangle2(0, 1, 2, 4))", "((((0.0 2.0) (1.0 2.0) (1.0 4.0) (0.0 4.0))))"},
                   {"rectangle2(0, 1, 2, 4) rect2region", "((((0.0 2.0) (1.0 2.0) (1.0 4.0) (0.0 4.0))))"},
                   {"rect2region(rectangle2(0, 0, 2, 4))", "undefined"},
                   {"rect2region([const rect value undefined])", "undefined"}},
      .errors = {{"query rect2region(1)", "rect2region: expected (rect), got (int)"}},
  });
}

void register_measures(Registry& registry) {
  registry.add({
      .name = "areaExact",
      .syntax = "areaExact(_)",
      .doc = "The area of a region as a fraction in lowest terms, p or p/q, in squared coordinate units.",
      .exactness = Exactness::exact,
      .overloads = {overload<&exact_area_text>("region")},
      .examples = {{"areaExact(" + kFrame + ")", "'12'"}, {"areaExact(" + kUndefinedRegion + ")", "undefined"}},
      .errors = {{"query areaExact(1)", "areaExact: expected (region), got (int)"}},
  });
  registry.add({
      .name = "perimeter",
      .syntax = "perimeter(_)",
      .doc = "The length of all segments that bound a region, in coordinate units; those of holes count.",
      .exactness = Exactness::two_ulp,
      .overloads = {overload<&perimeter_of>("region")},
      .examples = {{"perimeter(" + kFrame + ")", "24.0"}, {"perimeter(" + kUndefinedRegion + ")", "undefined"}},
      .errors = {{"query perimeter(1)", "perimeter: expected (region), got (int)"}},
  });
  registry.add({
      .name = "faceCount",
      .syntax = "faceCount(_)",
      .doc = "The number of faces of a region.",
      .detail = "As it is written: equal regions may be divided into faces and holes differently where these touch in "
                "points.",
      .exactness = Exactness::exact,
      .overloads = {overload<&face_count_of>("region")},
      .examples = {{"faceCount(" + kFrame + ")", "1"},
                   {"faceCount([const region value ()])", "0"},
                   {"faceCount(" + kUndefinedRegion + ")", "undefined"}},
      .errors = {{"query faceCount(1)", "faceCount: expected (region), got (int)"}},
  });
  registry.add({
      .name = "holeCount",
      .syntax = "holeCount(_)",
      .doc = "The number of holes in all faces of a region.",
      .detail = "As it is written, see `faceCount`.",
      .exactness = Exactness::exact,
      .overloads = {overload<&hole_count_of>("region")},
      .examples = {{"holeCount(" + kFrame + ")", "1"}, {"holeCount(" + kUndefinedRegion + ")", "undefined"}},
      .errors = {{"query holeCount(1)", "holeCount: expected (region), got (int)"}},
  });
}

void register_ways_to_space(Registry& registry) {
  registry.add({
      .name = "region2surface",
      .syntax = "region2surface(_)",
      .doc = "The region as a surface at z = 0, with normals upward.",
      .detail =
          "Each face is triangulated by a constrained Delaunay triangulation, holes left open. Corners are those of "
          "the region, and no others.",
      .exactness = Exactness::exact,
      .frame_use = FrameUse::coordinates,
      .sources = {"guibas1985", "dwyer1987", "anglada1997"},
      .overloads = {overload<&surface_of>("region")},
      .examples = {{"area(region2surface(" + kFrame + "))", "12.0"},
                   {"size(region2surface(" + kFrame + "))", "8"},
                   {"size(region2surface([const region value ()]))", "0"},
                   {"region2surface(" + kUndefinedRegion + ")", "undefined"}},
      .errors = {{"query region2surface(1)", "region2surface: expected (region), got (int)"}},
  });
  registry.add({
      .name = "region2volume",
      .syntax = "region2volume(_, _)",
      .doc = "The prism over a region: from z = 0 to the height, which may be negative.",
      .detail = "Undefined if the height is 0.",
      .exactness = Exactness::exact,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&prism_of>("region", "height")},
      .examples = {{"volume(region2volume(" + kFrame + ", 2.5))", "30.0"},
                   {"bbox(region2volume(" + kSquareRegion + ", -2))", "(0.0 4.0 0.0 4.0 -2.0 0.0)"},
                   {"region2volume(" + kSquareRegion + ", 0)", "undefined"},
                   {"region2volume(" + kUndefinedRegion + ", 1)", "undefined"}},
      .errors = {{"query region2volume(" + kSquareRegion + ")", "region2volume: expected (region real), got (region)"}},
  });
}

void register_ways_from_space(Registry& registry) {
  registry.add({
      .name = "slice",
      .syntax = "slice(_, _)",
      .doc = "The region in which the horizontal plane at a height cuts a solid.",
      .detail = "A solid that lies on the plane with a face, from above or below, has this in its slice; single points "
                "and segments do not count. Coordinates that are no doubles are kept as fractions.",
      .exactness = Exactness::exact,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&slice_of>("solid", "z")},
      .examples = {{"slice(" + kCubeOfTwo + ", 1.5)", "((((0.0 0.0) (2.0 0.0) (2.0 2.0) (0.0 2.0))))"},
                   {"slice(region2volume(" + kFrame + ", 3), 3) = " + kFrame, "TRUE"},
                   {"slice(" + kCubeOfTwo + ", 2.5)", "()"},
                   {"slice(" + kUndefinedSolid + ", 1)", "undefined"}},
      .errors = {{"query slice(" + kCubeOfTwo + ")", "slice: expected (volume3d real), got (volume3d)"}},
  });
  registry.add({
      .name = "projectXY",
      .syntax = "projectXY(_)",
      .doc = "The shadow of a solid on the plane z = 0, with light from straight above.",
      .exactness = Exactness::exact,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&shadow_of_solid>("solid")},
      .examples = {{"projectXY(" + kCubeOfTwo + ")", "((((0.0 0.0) (2.0 0.0) (2.0 2.0) (0.0 2.0))))"},
                   {"area(projectXY(" + kCubeOfTwo + " union createCube(makePoint3D(1, 1, 5), makePoint3D(3, 3, 6))))",
                    "7.0"},
                   {"projectXY(" + kUndefinedSolid + ")", "undefined"}},
      .errors = {{"query projectXY(1)", "projectXY: expected (volume3d), got (int)"}},
  });
}

}  // namespace

void register_regions(Registry& registry) {
  register_making(registry);
  register_measures(registry);
  register_ways_to_space(registry);
  register_ways_from_space(registry);
}

}  // namespace algebra3d
