// convexHull, boundingSphere: of points, boxes, surfaces and solids.
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "algebra3d/convex/convex_hull.h"
#include "algebra3d/convex/enclosing_ball.h"
#include "algebra3d/operators/all.h"
#include "algebra3d/operators/detail/point_arrays.h"
#include "algebra3d/operators/detail/sample_values.h"
#include "algebra3d/registry/operator.h"
#include "algebra3d/registry/overload.h"
#include "algebra3d/types/scalars.h"
#include "algebra3d/types/spatial.h"

namespace algebra3d {
namespace {

template <typename T>
Result<Maybe<Volume3d>> convex_hull_of(Context& context, const T& set) {
  ALGEBRA3D_ASSIGN_OR_RETURN(auto hull, convex_hull(spanning_points(set), context.monitor()));
  if (!hull) return Maybe<Volume3d>(Undefined{hull.reason()});
  return Maybe<Volume3d>(Volume3d::trusted(*std::move(hull)));
}

using BallRow = std::tuple<Point3d, std::optional<double>>;

template <typename T>
Result<Maybe<BallRow>> bounding_sphere_of(Context& context, const T& set) {
  const PointArray points = spanning_points(set);
  ALGEBRA3D_ASSIGN_OR_RETURN(const auto ball, smallest_enclosing_ball(points, context.monitor()));
  if (!ball) return Maybe<BallRow>(Undefined{"the empty set has no bounding sphere"});
  const RoundedBall rounded = rounded_ball(*ball, points);
  const std::optional radius = std::isfinite(rounded.radius) ? std::optional(rounded.radius) : std::nullopt;
  return Maybe<BallRow>(BallRow(Point3d{ExactPoint(rounded.centre)}, radius));
}

// The corners of a tetrahedron and a point inside.
const std::string kFivePoints = "(points3d ((0 0 0) (6 0 0) (0 6 0) (0 0 6) (1 1 1)))";

void register_convex_hull(Registry& registry) {
  registry.add({
      .name = "convexHull",
      .syntax = "convexHull(_)",
      .doc = "The convex hull of points, a box, a surface or a solid: the smallest convex solid that contains it.",
      .detail = "Its vertices are the extreme points, with their coordinates as they are. The hull of the empty set is "
                "empty; undefined if all points lie in one plane.",
      .exactness = Exactness::exact,
      .sources = {"barber1996"},
      .overloads = {overload<&convex_hull_of<Points3d>>("points"), overload<&convex_hull_of<Box3>>("box"),
                    overload<&convex_hull_of<Surface3d>>("surface"), overload<&convex_hull_of<Volume3d>>("solid")},
      // A sixth of 6 * 6 * 6.
      .examples = {{{kFivePoints}, "36.0", "(volume _)"},
                   {{kFivePoints}, "4", "(size _)"},
                   {{kCubeOfTwo}, "TRUE", "(= _ " + kCubeOfTwo + ")"},
                   {{"(surface3d (((0 0 0) (1 0 0) (0 1 0))))"}, "undefined"},
                   {{"(points3d ())"}, "TRUE", "(isempty _)"},
                   {{kUndefinedSolid}, "undefined"}},
      .errors = {{{"1"}, "convexHull: expected (points3d), (rect3), (surface3d) or (volume3d), got (int)"}},
  });
}

void register_bounding_sphere(Registry& registry) {
  registry.add({
      .name = "boundingSphere",
      .syntax = "boundingSphere(_)",
      .doc =
          "The smallest sphere around points, a box, a surface or a solid, in one row (Centre: point3d, Radius: real).",
      .detail =
          "The points that hold the sphere are found exactly. The centre is then rounded to doubles, and the radius is "
          "the smallest double for which the sphere with that centre contains the set. So Radius exceeds the smallest "
          "possible one by the rounding of the centre and one of its own at most. No row for the empty set; Radius is "
          "undefined if it is beyond the range of doubles.",
      .exactness = Exactness::rounded_once,
      .cost = Cost::linear,
      .sources = {"gaertner1999"},
      .overloads = {table<&bounding_sphere_of<Points3d>>({"Centre", "Radius"}, "points"),
                    table<&bounding_sphere_of<Box3>>({"Centre", "Radius"}, "box"),
                    table<&bounding_sphere_of<Surface3d>>({"Centre", "Radius"}, "surface"),
                    table<&bounding_sphere_of<Volume3d>>({"Centre", "Radius"}, "solid")},
      // Half of the diagonal of 2 x 3 x 6 is 3.5. The circle around a triangle with an obtuse angle is held by two
      // corners.
      .examples = {{{"(createCube (makePoint3D 0 0 0) (makePoint3D 2 3 6))"}, "(((1.0 1.5 3.0) 3.5))"},
                   {{"(points3d ((0 0 0) (10 0 0) (5 1 0)))"}, "(((5.0 0.0 0.0) 5.0))"},
                   {{"(rectangle3 0 0 0 3 0 4)"}, "(((0.0 1.5 2.0) 2.5))"},
                   {{"(points3d ())"}, "()"},
                   {{kUndefinedSolid}, "()"}},
      .errors = {{{"1"}, "boundingSphere: expected (points3d), (rect3), (surface3d) or (volume3d), got (int)"}},
  });
}

}  // namespace

void register_enclosing_shapes(Registry& registry) {
  register_convex_hull(registry);
  register_bounding_sphere(registry);
}

}  // namespace algebra3d
