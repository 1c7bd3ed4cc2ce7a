// rect3: rectangle3, enlargeRect, minD, maxD.
#include <cmath>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {
namespace {

Maybe<Box3> make_box(double x1, double x2, double y1, double y2, double z1, double z2) {
  const Box3 box{{x1, y1, z1}, {x2, y2, z2}};
  if (box.is_empty()) return Undefined{"a minimum is above its maximum"};
  return box;
}

// Each bound rounded outward, so that the result holds every point within the distances.
Maybe<Box3> enlarged(const Box3& box, double dx, double dy, double dz) {
  const Vec3 by{dx, dy, dz};
  Box3 result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Rational change(by[axis]);
    result.min[axis] = (Rational(box.min[axis]) - change).lower_double();
    result.max[axis] = (Rational(box.max[axis]) + change).upper_double();
  }
  if (!is_finite(result.min) || !is_finite(result.max)) return Undefined{"a bound is beyond the range of doubles"};
  if (result.is_empty()) return Undefined{"nothing is left of the box"};
  return result;
}

Maybe<double> bound(const Vec3& corner, std::int64_t dimension) {
  if (dimension < 1 || dimension > 3)
    return Undefined{fmt::format("there is no dimension {}; a rect3 has 1 to 3", dimension)};
  return corner[static_cast<std::size_t>(dimension - 1)];
}

Maybe<double> lower_bound(const Box3& box, std::int64_t dimension) {
  return bound(box.min, dimension);
}
Maybe<double> upper_bound(const Box3& box, std::int64_t dimension) {
  return bound(box.max, dimension);
}

const std::string kUndefinedBox = "(rect3 undefined)";
const std::string kUnit = "(rectangle3 0 1 0 1 0 1)";
const std::string kShifted = "(rectangle3 1 2 0 1 0 1)";

}  // namespace

void register_boxes(OperatorGroup& group) {
  group.add({
      .name = "rectangle3",
      .syntax = "rectangle3(_, _, _, _, _, _)",
      .doc = "The box with the given minimum and maximum of x, of y, and of z.",
      .detail = "Undefined if a minimum is above its maximum.",
      .exactness = Exactness::exact,
      .overloads = {overload<&make_box>("minX", "maxX", "minY", "maxY", "minZ", "maxZ")},
      .examples = {{{"0", "1", "0", "2", "0", "3"}, "(0.0 1.0 0.0 2.0 0.0 3.0)"},
                   {{"1", "0", "0", "2", "0", "3"}, "undefined"},
                   {{"0", "1", "0", "2", "0", "(real undefined)"}, "undefined"}},
      .errors = {{{"0", "1"}, "rectangle3: expected (real real real real real real), got (int int)"}},
  });
  group.add({
      .name = "enlargeRect",
      .syntax = "enlargeRect(_, _, _, _)",
      .doc = "The box with every bound moved outward by the distance given for its axis; negative distances shrink it.",
      .detail = "Undefined if the result is empty.",
      .exactness = Exactness::outward,
      .frame_use = FrameUse::axes,
      .overloads = {overload<&enlarged>("box", "dx", "dy", "dz")},
      .examples = {{{kUnit, "1", "0", "0.5"}, "(-1.0 2.0 0.0 1.0 -0.5 1.5)"},
                   {{kUnit, "-1", "0", "0"}, "undefined"},
                   {{kUndefinedBox, "1", "1", "1"}, "undefined"}},
      .errors = {{{kUnit, "1"}, "enlargeRect: expected (rect3 real real real), got (rect3 int)"}},
  });
  group.add({
      .name = "minD",
      .syntax = "minD(_, _)",
      .doc = "The lower bound of a box in a dimension, counted from 1.",
      .exactness = Exactness::exact,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&lower_bound>("box", "dimension")},
      .examples = {{{kShifted, "1"}, "1.0"}, {{kShifted, "4"}, "undefined"}, {{kUndefinedBox, "1"}, "undefined"}},
      .errors = {{{kUnit, "1.5"}, "minD: expected (rect3 int), got (rect3 real)"}},
  });
  group.add({
      .name = "maxD",
      .syntax = "maxD(_, _)",
      .doc = "The upper bound of a box in a dimension, counted from 1.",
      .exactness = Exactness::exact,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&upper_bound>("box", "dimension")},
      .examples = {{{kShifted, "1"}, "2.0"}, {{kShifted, "0"}, "undefined"}, {{kUndefinedBox, "1"}, "undefined"}},
      .errors = {{{kUnit, "1.5"}, "maxD: expected (rect3 int), got (rect3 real)"}},
  });
}

}  // namespace algebra3d
