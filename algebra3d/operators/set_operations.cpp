// union, intersection, minus, symmetricDifference: of boxes, points, solids, surfaces and regions.
#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "algebra3d/operators/all.h"
#include "algebra3d/operators/region_meshes.h"
#include "algebra3d/operators/sample_values.h"
#include "algebra3d/operators/solid_sets.h"
#include "algebra3d/registry/overload.h"

namespace algebra3d {
namespace {

Box3 box_union(const Box3& a, const Box3& b) {
  return unite(a, b);
}

Maybe<Box3> box_intersection(const Box3& a, const Box3& b) {
  const Box3 common = intersect(a, b);
  if (common.is_empty()) return Undefined{"the boxes do not meet"};
  return common;
}

std::span<const ExactPoint> points_of(const Point3d& point) {
  return {&point.position, 1};
}
std::span<const ExactPoint> points_of(const Points3d& points) {
  return points.points();
}

/// Applies a merge of the standard library to two ordered sets of points.
template <typename A, typename B, typename Merge>
Points3d merged(const A& a, const B& b, Merge merge) {
  std::vector<ExactPoint> result;
  merge(points_of(a), points_of(b), std::back_inserter(result));
  return Points3d(std::move(result));
}

template <typename A, typename B>
Points3d point_union(const A& a, const B& b) {
  return merged(a, b, std::ranges::set_union);
}
template <typename A, typename B>
Points3d point_intersection(const A& a, const B& b) {
  return merged(a, b, std::ranges::set_intersection);
}
template <typename A, typename B>
Points3d point_minus(const A& a, const B& b) {
  return merged(a, b, std::ranges::set_difference);
}
template <typename A, typename B>
Points3d point_symmetric_difference(const A& a, const B& b) {
  return merged(a, b, std::ranges::set_symmetric_difference);
}

Result<Volume3d> solid_union(Context& context, const Volume3d& a, const Volume3d& b) {
  return united(context, std::array<Volume3d, 2>{a, b});
}
Result<Volume3d> solid_intersection(Context& context, const Volume3d& a, const Volume3d& b) {
  return intersected(context, std::array<Volume3d, 2>{a, b});
}
Result<Volume3d> solid_minus(Context& context, const Volume3d& a, const Volume3d& b) {
  return without(context, a, b);
}
Result<Volume3d> solid_symmetric_difference(Context& context, const Volume3d& a, const Volume3d& b) {
  return in_either(context, a, b);
}

template <SurfaceRule kRule>
Result<Surface3d> surface_sets(Context& context, const Surface3d& a, const Surface3d& b) {
  return combined(context, a, b, kRule);
}

template <SurfaceRule kRule>
Result<Region> region_sets(Context& context, const Region& a, const Region& b) {
  return combined_regions(a, b, kRule, context.monitor());
}

/// An operation on points, on each side one point or many; the operands may change places.
#define SYMMETRIC_POINT_OVERLOADS(operation)                                                                      \
  symmetric(overload<&operation<Point3d, Point3d>>("a", "b")), overload<&operation<Point3d, Points3d>>("a", "b"), \
      overload<&operation<Points3d, Point3d>>("a", "b"), symmetric(overload<&operation<Points3d, Points3d>>("a", "b"))

const std::string kBoxA = "rectangle3(0, 1, 0, 1, 0, 1)";
const std::string kBoxB = "rectangle3(1, 2, 0, 1, 0, 1)";
const std::string kPointsA = "[const points3d value ((0 0 0) (1 0 0))]";
const std::string kPointB = "makePoint3D(1, 0, 0)";
const std::string kCubeA = "createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))";
const std::string kCubeB = "createCube(makePoint3D(1, 1, 1), makePoint3D(3, 3, 3))";
const std::string kSquareA = "[const surface3d value (((0 0 0) (2 0 0) (2 2 0)) ((0 0 0) (2 2 0) (0 2 0)))]";
const std::string kSquareB = "[const surface3d value (((1 1 0) (3 1 0) (3 3 0)) ((1 1 0) (3 3 0) (1 3 0)))]";

constexpr const char* kSolids =
    "Solids: the regularised operation on closed solids, without left-overs of lower dimension; containment, cavities "
    "and bodies that touch are right. Where the operands touch, faces in one plane are brought together, and the "
    "result "
    "has no more corners and triangles there than it needs. Nothing is rounded: corners that are no doubles are kept "
    "as "
    "fractions, and the laws of set algebra hold. Surfaces: their triangles are divided at one another; pieces are "
    "kept "
    "that lie in either, in both (where they cover each other), or in the first alone.";

void register_infix_sets(Registry& registry) {
  registry.add({
      .name = "union",
      .syntax = "_ union _",
      .doc = "What lies in one of two sets of points, surfaces, solids or regions, or in both; the smallest box around "
             "two boxes.",
      .detail = kSolids,
      .exactness = Exactness::exact,
      .overloads = {symmetric(overload<&box_union>("a", "b")), SYMMETRIC_POINT_OVERLOADS(point_union),
                    symmetric(overload<&surface_sets<SurfaceRule::either>>("a", "b")),
                    symmetric(overload<&solid_union>("a", "b")),
                    symmetric(overload<&region_sets<SurfaceRule::either>>("a", "b"))},
      .examples = {{"size(" + kCubeA + " union " + kCubeB + ")", "36"},
                   {"volume(" + kCubeA + " union " + kCubeB + ")", "15.0"},
                   {"area(" + kSquareA + " union " + kSquareB + ")", "7.0"},
                   {kPointsA + " union " + kPointB, "((0.0 0.0 0.0) (1.0 0.0 0.0))"},
                   {kBoxA + " union " + kBoxB, "(0.0 2.0 0.0 1.0 0.0 1.0)"},
                   {kCubeA + " union " + kUndefinedSolid, "undefined"}},
      .errors = {{"query " + kBoxA + " union 1", "union: expected (rect3 rect3)"}},
  });
  registry.add({
      .name = "minus",
      .syntax = "_ minus _",
      .doc = "What lies in the first of two sets of points, surfaces, solids or regions and not in the second.",
      .detail = kSolids,
      .exactness = Exactness::exact,
      .overloads = {overload<&point_minus<Point3d, Point3d>>("a", "b"),
                    overload<&point_minus<Point3d, Points3d>>("a", "b"),
                    overload<&point_minus<Points3d, Point3d>>("a", "b"),
                    overload<&point_minus<Points3d, Points3d>>("a", "b"),
                    overload<&surface_sets<SurfaceRule::first_only>>("a", "b"), overload<&solid_minus>("a", "b"),
                    overload<&region_sets<SurfaceRule::first_only>>("a", "b")},
      .examples = {{"volume(" + kCubeA + " minus " + kCubeB + ")", "7.0"},
                   {"size(" + kCubeA + " minus " + kCubeA + ")", "0"},
                   {"area(" + kSquareA + " minus " + kSquareB + ")", "3.0"},
                   {kPointsA + " minus " + kPointB, "((0.0 0.0 0.0))"},
                   {kCubeA + " minus " + kUndefinedSolid, "undefined"}},
      .errors = {{"query " + kCubeA + " minus 1", "minus: expected (point3d point3d)"}},
  });
}

void register_prefix_sets(Registry& registry) {
  registry.add({
      .name = "intersection",
      .syntax = "intersection(_, _)",
      .doc = "What lies in both of two sets of points, surfaces, solids or regions, or in two boxes.",
      .detail = std::string(kSolids) + " Boxes that do not meet have no common part: undefined.",
      .exactness = Exactness::exact,
      .overloads = {symmetric(overload<&box_intersection>("a", "b")), SYMMETRIC_POINT_OVERLOADS(point_intersection),
                    symmetric(overload<&surface_sets<SurfaceRule::both>>("a", "b")),
                    symmetric(overload<&solid_intersection>("a", "b")),
                    symmetric(overload<&region_sets<SurfaceRule::both>>("a", "b"))},
      .examples = {{"volume(intersection(" + kCubeA + ", " + kCubeB + "))", "1.0"},
                   {"area(intersection(" + kSquareA + ", " + kSquareB + "))", "1.0"},
                   {"intersection(" + kPointsA + ", " + kPointB + ")", "((1.0 0.0 0.0))"},
                   {"intersection(" + kBoxA + ", " + kBoxB + ")", "(1.0 1.0 0.0 1.0 0.0 1.0)"},
                   {"intersection(" + kBoxA + ", rectangle3(2, 3, 0, 1, 0, 1))", "undefined"},
                   {"intersection(" + kCubeA + ", " + kUndefinedSolid + ")", "undefined"}},
      .errors = {{"query intersection(" + kBoxA + ", 1)", "intersection: expected (rect3 rect3)"}},
  });
  registry.add({
      .name = "symmetricDifference",
      .syntax = "symmetricDifference(_, _)",
      .doc = "What lies in exactly one of two sets of points, surfaces, solids or regions.",
      .detail = kSolids,
      .exactness = Exactness::exact,
      .overloads = {SYMMETRIC_POINT_OVERLOADS(point_symmetric_difference),
                    symmetric(overload<&surface_sets<SurfaceRule::exactly_one>>("a", "b")),
                    symmetric(overload<&solid_symmetric_difference>("a", "b")),
                    symmetric(overload<&region_sets<SurfaceRule::exactly_one>>("a", "b"))},
      .examples = {{"volume(symmetricDifference(" + kCubeA + ", " + kCubeB + "))", "14.0"},
                   {"symmetricDifference(" + kPointsA + ", makePoint3D(2, 0, 0))",
                    "((0.0 0.0 0.0) (1.0 0.0 0.0) (2.0 0.0 0.0))"},
                   {"symmetricDifference(" + kCubeA + ", " + kUndefinedSolid + ")", "undefined"}},
      .errors = {{"query symmetricDifference(" + kCubeA + ", 1)", "symmetricDifference: expected (point3d point3d)"}},
  });
}

#undef SYMMETRIC_POINT_OVERLOADS

}  // namespace

void register_set_operations(Registry& registry) {
  register_infix_sets(registry);
  register_prefix_sets(registry);
}

}  // namespace algebra3d
