// createCube, createCylinder, createCone, createSphere.
#include <string>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/constructions/shape_makers.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {
namespace {

const std::string kRoundNote =
    "Each coordinate is rounded once. Undefined if the radius or height is not positive, with fewer than 3 corners or "
    "more than 10 million, and if the shape collapses when its corners are rounded to doubles.";

void register_round_prism(OperatorGroup& group) {
  group.add({
      .name = "createCylinder",
      .syntax = "createCylinder(_, _, _, _)",
      .doc = "An upright prism over a regular polygon: centre of its base, radius, height and number of corners.",
      .detail = "The base lies in the horizontal plane of the centre, with its first corner in direction +x; 4n - 4 "
                "triangles. " +
                kRoundNote,
      .exactness = Exactness::rounded_once,
      .frame_use = FrameUse::axes,
      .overloads = {overload<&upright_prism>("base", "radius", "height", "n")},
      .examples = {{{kOrigin, "1", "3", "4"}, "6.0", "(volume _)"},
                   {{kOrigin, "1", "3", "12"}, "44", "(size _)"},
                   {{kOrigin, "1", "3", "2"}, "undefined"},
                   {{kUndefinedPoint, "1", "3", "12"}, "undefined"}},
      .errors = {{{kOrigin, "1", "3"}, "createCylinder: expected (point3d real real int), got (point3d int int)"}},
  });
  group.add({
      .name = "createCone",
      .syntax = "createCone(_, _, _, _)",
      .doc = "An upright pyramid over a regular polygon: centre of its base, radius, height and number of corners.",
      .detail = "The apex lies above the centre; 2n - 2 triangles. " + kRoundNote,
      .exactness = Exactness::rounded_once,
      .frame_use = FrameUse::axes,
      .overloads = {overload<&upright_pyramid>("base", "radius", "height", "n")},
      .examples = {{{kOrigin, "1", "3", "4"}, "2.0", "(volume _)"},
                   {{kOrigin, "1", "3", "12"}, "22", "(size _)"},
                   {{kOrigin, "0", "3", "12"}, "undefined"},
                   {{kUndefinedPoint, "1", "3", "12"}, "undefined"}},
      .errors = {{{kOrigin, "1", "3"}, "createCone: expected (point3d real real int), got (point3d int int)"}},
  });
}

}  // namespace

void register_creation(OperatorGroup& group) {
  group.add({
      .name = "createCube",
      .syntax = "createCube(_, _)",
      .doc = "The axis-parallel box between two corners, given in any order, as 12 triangles.",
      .detail = "Undefined if the box has no extent along an axis.",
      .exactness = Exactness::exact,
      .overloads = {symmetric(overload<&box_between>("p", "q"))},
      .examples = {{{"(makePoint3D 1 1 1)", "(makePoint3D 0 -1 4)"}, "6.0", "(volume _)"},
                   {{kOrigin, "(makePoint3D 1 1 1)"}, "12", "(size _)"},
                   {{kOrigin, "(makePoint3D 1 0 1)"}, "undefined"},
                   {{kOrigin, kUndefinedPoint}, "undefined"}},
      .errors = {{{kOrigin, "1"}, "createCube: expected (point3d point3d), got (point3d int)"}},
  });
  register_round_prism(group);
  group.add({
      .name = "createSphere",
      .syntax = "createSphere(_, _, _)",
      .doc = "A polyhedron that approximates a sphere: centre, radius and number of corners of its circles.",
      .detail =
          "An odd number of corners n is increased by 1. A half circle of n/2 steps from (1, 0, 0) to (-1, 0, 0) is "
          "turned about the x axis in n steps, scaled by the radius and moved to the centre; n(n - 2) triangles, at "
          "most 40 million. " +
          kRoundNote,
      .exactness = Exactness::rounded_once,
      .frame_use = FrameUse::axes,
      .overloads = {overload<&sphere_polyhedron>("centre", "radius", "n")},
      // With 4 corners, the octahedron: 4/3 r^3.
      .examples = {{{kOrigin, "3", "4"}, "36.0", "(volume _)"},
                   {{kOrigin, "1", "11"}, "120", "(size _)"},
                   {{"(makePoint3D 1 2 3)", "0.5", "8"}, "(0.5 1.5 1.5 2.5 2.5 3.5)", "(bbox _)"},
                   {{kOrigin, "-1", "8"}, "undefined"},
                   {{kUndefinedPoint, "1", "8"}, "undefined"}},
      .errors = {{{kOrigin, "1"}, "createSphere: expected (point3d real int), got (point3d int)"}},
  });
}

}  // namespace algebra3d
