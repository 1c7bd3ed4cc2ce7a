// union, intersection, minus, symmetricDifference: of boxes, points, solids, surfaces and regions.
#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/box_solids.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/constructions/region_meshes.h"
#include "algebra3d/values/constructions/solid_sets.h"
#include "base/propagate.h"

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

using SolidOperation = Result<Volume3d> (*)(Context&, const Volume3d&, const Volume3d&);

/// The operation on a solid and a box, or on two boxes, as solids. Undefined for a flat box.
template <SolidOperation kOperation, typename A, typename B>
Result<Maybe<Volume3d>> with_boxes(Context& context, const A& a, const B& b) {
  const Maybe<Volume3d> first = solid_of(a), second = solid_of(b);
  if (!first) return first;
  if (!second) return second;
  A3D_ASSIGN(Volume3d result, kOperation(context, *first, *second));
  return Maybe<Volume3d>(std::move(result));
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
#define ALGEBRA3D_SYMMETRIC_POINT_OVERLOADS(operation)                                                            \
  symmetric(overload<&operation<Point3d, Point3d>>("a", "b")), overload<&operation<Point3d, Points3d>>("a", "b"), \
      overload<&operation<Points3d, Point3d>>("a", "b"), symmetric(overload<&operation<Points3d, Points3d>>("a", "b"))

/// An operation on a solid and a box, in either order.
#define ALGEBRA3D_BOX_OVERLOADS(operation)                     \
  overload<&with_boxes<&operation, Volume3d, Box3>>("a", "b"), \
      overload<&with_boxes<&operation, Box3, Volume3d>>("a", "b")

const std::string kBoxA = "(rectangle3 0 1 0 1 0 1)";
const std::string kBoxB = "(rectangle3 1 2 0 1 0 1)";
const std::string kFlatBox = "(rectangle3 0 1 0 1 1 1)";
const std::string kPointsA = "(points3d ((0 0 0) (1 0 0)))";
const std::string kPointB = "(makePoint3D 1 0 0)";
const std::string kCubeA = "(createCube (makePoint3D 0 0 0) (makePoint3D 2 2 2))";
const std::string kCubeB = "(createCube (makePoint3D 1 1 1) (makePoint3D 3 3 3))";
const std::string kSquareA = "(surface3d (((0 0 0) (2 0 0) (2 2 0)) ((0 0 0) (2 2 0) (0 2 0))))";
const std::string kSquareB = "(surface3d (((1 1 0) (3 1 0) (3 3 0)) ((1 1 0) (3 3 0) (1 3 0))))";

constexpr const char* kSolids =
    "Solids: the regularised operation, without parts of lower dimension; also for solids with cavities, and for "
    "operands that contain or touch each other. Where the operands touch, coplanar faces are merged, and the result "
    "has no superfluous corners and triangles there. Nothing is rounded: corners that are not doubles are kept as "
    "fractions, and the laws of set algebra hold. Surfaces: their triangles are divided at one another; the parts "
    "are kept that lie in either, in both (where they overlap), or in the first only. A box beside a solid is the "
    "solid "
    "of its points; undefined for a flat one.";

void register_infix_sets(OperatorGroup& group) {
  group.add({
      .name = "union",
      .host_name = "union_of",
      .syntax = "_ union _",
      .doc = "The union of two sets of points, surfaces, solids or regions; the smallest box around two boxes.",
      .detail = kSolids,
      .exactness = Exactness::exact,
      .overloads = {symmetric(overload<&box_union>("a", "b")), ALGEBRA3D_SYMMETRIC_POINT_OVERLOADS(point_union),
                    symmetric(overload<&surface_sets<SurfaceRule::either>>("a", "b")),
                    symmetric(overload<&solid_union>("a", "b")), ALGEBRA3D_BOX_OVERLOADS(solid_union),
                    symmetric(overload<&region_sets<SurfaceRule::either>>("a", "b"))},
      .examples = {{{kCubeA, kCubeB}, "36", "(size _)"},
                   {{kCubeA, kCubeB}, "15.0", "(volume _)"},
                   {{kSquareA, kSquareB}, "7.0", "(area _)"},
                   {{kPointsA, kPointB}, "((0.0 0.0 0.0) (1.0 0.0 0.0))"},
                   {{kBoxA, kBoxB}, "(0.0 2.0 0.0 1.0 0.0 1.0)"},
                   {{kCubeB, kBoxA}, "9.0", "(volume _)"},
                   {{kCubeA, kUndefinedSolid}, "undefined"}},
      .errors = {{{kBoxA, "1"}, "union: expected (rect3 rect3)"}},
  });
  group.add({
      .name = "intersection",
      .syntax = "_ intersection _",
      .also_prefix = true,
      .doc = "The intersection of two sets of points, surfaces, solids, regions or boxes.",
      .detail = std::string(kSolids) + " Undefined for boxes that do not meet.",
      .exactness = Exactness::exact,
      .overloads = {symmetric(overload<&box_intersection>("a", "b")),
                    ALGEBRA3D_SYMMETRIC_POINT_OVERLOADS(point_intersection),
                    symmetric(overload<&surface_sets<SurfaceRule::both>>("a", "b")),
                    symmetric(overload<&solid_intersection>("a", "b")), ALGEBRA3D_BOX_OVERLOADS(solid_intersection),
                    symmetric(overload<&region_sets<SurfaceRule::both>>("a", "b"))},
      .examples = {{{kCubeA, kCubeB}, "1.0", "(volume _)"},
                   {{kSquareA, kSquareB}, "1.0", "(area _)"},
                   {{kPointsA, kPointB}, "((1.0 0.0 0.0))"},
                   {{kBoxA, kBoxB}, "(1.0 1.0 0.0 1.0 0.0 1.0)"},
                   {{kBoxA, "(rectangle3 2 3 0 1 0 1)"}, "undefined"},
                   {{kBoxA, kCubeA}, "1.0", "(volume _)"},
                   {{kCubeA, kUndefinedSolid}, "undefined"}},
      .errors = {{{kBoxA, "1"}, "intersection: expected (rect3 rect3)"}},
  });
  group.add({
      .name = "minus",
      .host_name = "difference",
      .syntax = "_ minus _",
      .doc = "The difference of two sets of points, surfaces, solids, regions or boxes: the first without the second.",
      .detail = std::string(kSolids) + " So is each of two boxes.",
      .exactness = Exactness::exact,
      .overloads = {overload<&point_minus<Point3d, Point3d>>("a", "b"),
                    overload<&point_minus<Point3d, Points3d>>("a", "b"),
                    overload<&point_minus<Points3d, Point3d>>("a", "b"),
                    overload<&point_minus<Points3d, Points3d>>("a", "b"),
                    overload<&surface_sets<SurfaceRule::first_only>>("a", "b"), overload<&solid_minus>("a", "b"),
                    ALGEBRA3D_BOX_OVERLOADS(solid_minus), overload<&with_boxes<&solid_minus, Box3, Box3>>("a", "b"),
                    overload<&region_sets<SurfaceRule::first_only>>("a", "b")},
      .examples = {{{kCubeA, kCubeB}, "7.0", "(volume _)"},
                   {{kCubeA, kCubeA}, "0", "(size _)"},
                   {{kSquareA, kSquareB}, "3.0", "(area _)"},
                   {{kPointsA, kPointB}, "((0.0 0.0 0.0))"},
                   {{kCubeA, kBoxA}, "7.0", "(volume _)"},
                   {{kCubeA, kFlatBox}, "undefined"},
                   {{kCubeA, kUndefinedSolid}, "undefined"}},
      .errors = {{{kCubeA, "1"}, "minus: expected (volume3d volume3d), (volume3d rect3)"}},
  });
}

void register_symmetric_difference(OperatorGroup& group) {
  group.add({
      .name = "symmetricDifference",
      .syntax = "symmetricDifference(_, _)",
      .doc =
          "The symmetric difference of two sets of points, surfaces, solids, regions or boxes: the points in exactly "
          "one of them.",
      .detail = std::string(kSolids) + " So is each of two boxes.",
      .exactness = Exactness::exact,
      .overloads = {ALGEBRA3D_SYMMETRIC_POINT_OVERLOADS(point_symmetric_difference),
                    symmetric(overload<&surface_sets<SurfaceRule::exactly_one>>("a", "b")),
                    symmetric(overload<&solid_symmetric_difference>("a", "b")),
                    ALGEBRA3D_BOX_OVERLOADS(solid_symmetric_difference),
                    symmetric(overload<&with_boxes<&solid_symmetric_difference, Box3, Box3>>("a", "b")),
                    symmetric(overload<&region_sets<SurfaceRule::exactly_one>>("a", "b"))},
      .examples = {{{kCubeA, kCubeB}, "14.0", "(volume _)"},
                   {{kPointsA, "(makePoint3D 2 0 0)"}, "((0.0 0.0 0.0) (1.0 0.0 0.0) (2.0 0.0 0.0))"},
                   {{kBoxA, kBoxB}, "2.0", "(volume _)"},
                   {{kCubeA, kUndefinedSolid}, "undefined"}},
      .errors = {{{kCubeA, "1"}, "symmetricDifference: expected (volume3d volume3d), (volume3d rect3)"}},
  });
}

#undef ALGEBRA3D_BOX_OVERLOADS
#undef ALGEBRA3D_SYMMETRIC_POINT_OVERLOADS

}  // namespace

void register_set_operations(OperatorGroup& group) {
  register_infix_sets(group);
  register_symmetric_difference(group);
}

}  // namespace algebra3d
