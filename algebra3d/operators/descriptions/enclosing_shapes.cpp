// convexHull, boundingSphere, minimalBox, boundingCylinder: of points, boxes, surfaces and solids.

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "algebra3d/kernel/convex/bounding_cylinder.h"
#include "algebra3d/kernel/convex/convex_hull.h"
#include "algebra3d/kernel/convex/enclosing_ball.h"
#include "algebra3d/kernel/convex/minimal_box.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "base/box_corners.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

PointArray spanning_points(const Points3d& set) {
  PointArray points;
  points.reserve(set.points().size());
  for (const ExactPoint& point : set.points()) points.push_back(point);
  return points;
}

PointArray spanning_points(const Surface3d& surface) {
  return used_points(surface.mesh());
}

PointArray spanning_points(const Volume3d& solid) {
  return used_points(solid.mesh());
}

PointArray spanning_points(const Box3& box) {
  std::vector<Vec3> corners;
  for (unsigned i = 0; i < 8; ++i) corners.push_back(corner_of(box, i));
  return PointArray(std::move(corners));
}

/// Undefined beyond the range of doubles.
std::optional<double> cell(double number) {
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::optional<double> cell(const Rational& number) {
  return cell(number.nearest_double());
}

template <typename T>
Result<Maybe<Volume3d>> convex_hull_of(Context& context, const T& set) {
  A3D_ASSIGN(auto hull, convex_hull(spanning_points(set), context.monitor()));
  if (!hull) return Maybe<Volume3d>(Undefined{hull.reason()});
  return Maybe<Volume3d>(Volume3d::trusted(*std::move(hull)));
}

using BallRow = std::tuple<Point3d, std::optional<double>>;

template <typename T>
Result<Maybe<BallRow>> bounding_sphere_of(Context& context, const T& set) {
  const PointArray points = spanning_points(set);
  A3D_ASSIGN(const auto ball, smallest_enclosing_ball(points, context.monitor()));
  if (!ball) return Maybe<BallRow>(Undefined{"the empty set has no bounding sphere"});
  const RoundedBall rounded = rounded_ball(*ball, points);
  return Maybe<BallRow>(BallRow(Point3d{ExactPoint(rounded.centre)}, cell(rounded.radius)));
}

/// Calls make(hull) for the hull of a set that has a volume.
template <typename Row, typename T, typename Make>
Result<Maybe<Row>> row_of_hull(Context& context, const T& set, const Make& make) {
  A3D_ASSIGN(const auto hull, convex_hull(spanning_points(set), context.monitor()));
  if (!hull) return Maybe<Row>(Undefined{hull.reason()});
  if (hull->is_empty()) return Maybe<Row>(Undefined{"nothing encloses the empty set"});
  return make(*hull);
}

using BoxRow = std::tuple<Volume3d, std::optional<double>, std::optional<double>, std::optional<double>,
                          std::optional<double>, std::optional<double>>;

template <typename T>
Result<Maybe<BoxRow>> minimal_box_of(Context& context, const T& set) {
  return row_of_hull<BoxRow>(context, set, [&](const TriangleMesh& hull) -> Result<Maybe<BoxRow>> {
    A3D_ASSIGN(auto box, minimal_box(hull, context.monitor()));
    if (!box) return Maybe<BoxRow>(Undefined{box.reason()});
    const auto& [length, width, height] = box->sizes;
    return Maybe<BoxRow>(BoxRow(Volume3d::trusted(std::move(box->mesh)), cell(length), cell(width), cell(height),
                                cell(length * width * height), cell(box->ratio)));
  });
}

using CylinderRow = std::tuple<Point3d, Vector3d, double, double, std::optional<double>, std::optional<double>>;

template <typename T>
Result<Maybe<CylinderRow>> bounding_cylinder_of(Context& context, const T& set) {
  return row_of_hull<CylinderRow>(context, set, [&](const TriangleMesh& hull) -> Result<Maybe<CylinderRow>> {
    A3D_ASSIGN(const auto found, bounding_cylinder(hull, context.monitor()));
    if (!found) return Maybe<CylinderRow>(Undefined{"the cylinder is beyond the range of doubles"});
    const double volume = std::numbers::pi * found->radius * found->radius * found->height;
    return Maybe<CylinderRow>(CylinderRow(Point3d{ExactPoint(found->base)}, Vector3d{ExactPoint(found->axis)},
                                          found->radius, found->height, cell(volume), cell(found->ratio)));
  });
}

/// The overloads Maker::make<T>(name of the parameter) for all kinds of sets.
template <typename Maker>
std::vector<Overload> overloads_of_sets() {
  return {Maker::template make<Points3d>("points"), Maker::template make<Box3>("box"),
          Maker::template make<Surface3d>("surface"), Maker::template make<Volume3d>("solid")};
}

struct HullMaker {
  template <typename T>
  static Overload make(const char* name) {
    return overload<&convex_hull_of<T>>(name);
  }
};
struct SphereMaker {
  template <typename T>
  static Overload make(const char* name) {
    return table<&bounding_sphere_of<T>>({"Centre", "Radius"}, name);
  }
};
struct BoxMaker {
  template <typename T>
  static Overload make(const char* name) {
    return table<&minimal_box_of<T>>({"Box", "Length", "Width", "Height", "Volume", "Ratio"}, name);
  }
};
struct CylinderMaker {
  template <typename T>
  static Overload make(const char* name) {
    return table<&bounding_cylinder_of<T>>({"Base", "Axis", "Radius", "Height", "Volume", "Ratio"}, name);
  }
};

// The corners of a tetrahedron and a point inside.
const std::string kFivePoints = "(points3d ((0 0 0) (6 0 0) (0 6 0) (0 0 6) (1 1 1)))";

void register_convex_hull(OperatorGroup& group) {
  group.add({
      .name = "convexHull",
      .syntax = "convexHull(_)",
      .doc = "The convex hull of points, a box, a surface or a solid: the smallest convex solid that contains it.",
      .detail = "Its vertices are the extreme points, with their coordinates as they are. The hull of the empty set is "
                "empty; undefined if all points lie in one plane.",
      .exactness = Exactness::exact,
      .sources = {"barber1996"},
      .overloads = overloads_of_sets<HullMaker>(),
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

void register_bounding_sphere(OperatorGroup& group) {
  group.add({
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
      .overloads = overloads_of_sets<SphereMaker>(),
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

constexpr const char* kMeaningOfRatio =
    " Ratio is a proved upper bound of its volume by the smallest possible one: at most 1.05 unless the search, which "
    "divides at most 5,000 times, ends before, as it may for sets with a thousand corners on a sphere. Undefined (no "
    "row) "
    "if the set is empty or flat; numbers beyond the range of doubles are undefined.";

void register_minimal_box(OperatorGroup& group) {
  group.add({
      .name = "minimalBox",
      .syntax = "minimalBox(_)",
      .doc =
          "A cuboid in any orientation around points, a box, a surface or a solid, with nearly the smallest volume, in "
          "one row (Box: volume3d, Length, Width, Height, Volume, Ratio: real).",
      .detail =
          std::string("Box has exact corners, contains the set exactly, and touches it with each side. Length, Width "
                      "and Height are its sizes, descending, and Volume its volume, each rounded once.") +
          kMeaningOfRatio,
      .exactness = Exactness::rounded_once,
      .frame_use = FrameUse::axes,
      .sources = {"orourke1985", "freeman1975"},
      .overloads = overloads_of_sets<BoxMaker>(),
      .examples = {{{"(createCube (makePoint3D 0 0 0) (makePoint3D 2 3 6))"}, "1", "(count _)"},
                   {{"(points3d ())"}, "()"},
                   {{"(points3d ((0 0 0) (1 0 0) (0 1 0)))"}, "()"},
                   {{kUndefinedSolid}, "()"}},
      .errors = {{{"1"}, "minimalBox: expected (points3d), (rect3), (surface3d) or (volume3d), got (int)"}},
  });
}

void register_bounding_cylinder(OperatorGroup& group) {
  group.add({
      .name = "boundingCylinder",
      .syntax = "boundingCylinder(_)",
      .doc = "A cylinder in any orientation around points, a box, a surface or a solid, with nearly the smallest "
             "volume, in "
             "one row (Base: point3d, Axis: vector3d, Radius, Height, Volume, Ratio: real).",
      .detail =
          std::string(
              "Base is the centre of one end, from which Axis, a unit vector, points to the other. Radius and "
              "Height are enlarged by 2^-40 of the size of the set, and 2^-50 of its coordinates, so that "
              "the cylinder contains the set in spite of rounding. No row if it is beyond the range of doubles.") +
          kMeaningOfRatio,
      .exactness = Exactness::not_numeric,
      .frame_use = FrameUse::axes,
      .sources = {"welzl1991"},
      .overloads = overloads_of_sets<CylinderMaker>(),
      .examples = {{{"(createCube (makePoint3D 0 0 0) (makePoint3D 2 3 6))"}, "1", "(count _)"},
                   {{"(points3d ())"}, "()"},
                   {{"(points3d ((0 0 0) (1 0 0) (0 1 0)))"}, "()"},
                   {{kUndefinedSolid}, "()"}},
      .errors = {{{"1"}, "boundingCylinder: expected (points3d), (rect3), (surface3d) or (volume3d), got (int)"}},
  });
}

}  // namespace

void register_enclosing_shapes(OperatorGroup& group) {
  register_convex_hull(group);
  register_bounding_sphere(group);
  register_minimal_box(group);
  register_bounding_cylinder(group);
}

}  // namespace algebra3d
