// isCongruent, congruence: solids that are equal up to a motion.
#include "algebra3d/kernel/congruence/congruence.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

CongruenceOperand congruence_operand(const Volume3d& solid) {
  return {&solid.mesh(), &solid.geometry().hierarchy()};
}

Result<std::optional<RigidMotion>> motion_between(Context& context, const Volume3d& a, const Volume3d& b,
                                                  double tolerance) {
  return find_congruence(congruence_operand(a), congruence_operand(b), tolerance, context.monitor());
}

Result<bool> are_congruent(Context& context, const Volume3d& a, const Volume3d& b, double tolerance) {
  if (a.mesh().is_empty() || b.mesh().is_empty()) return a.mesh().is_empty() && b.mesh().is_empty() && tolerance >= 0;
  A3D_ASSIGN(const auto motion, motion_between(context, a, b, tolerance));
  return motion.has_value();
}

using MotionRow = std::tuple<Point3d, Vector3d, double, Vector3d, bool>;

Result<std::optional<MotionRow>> congruence_row(Context& context, const Volume3d& a, const Volume3d& b,
                                                double tolerance) {
  A3D_ASSIGN(const auto motion, motion_between(context, a, b, tolerance));
  if (!motion || !is_finite(motion->translation)) return std::optional<MotionRow>();
  return std::optional(MotionRow(Point3d{ExactPoint(motion->centre)}, Vector3d{ExactPoint(motion->axis)},
                                 motion->angle_degrees, Vector3d{ExactPoint(motion->translation)},
                                 motion->is_mirrored));
}

constexpr const char* kMeaningOfCongruence =
    "After the motion no point of either boundary is farther than the tolerance, in coordinate units, from the other "
    "boundary; so the triangles do not matter. The motion is searched among those that map the centres of mass to each "
    "other, and the principal axes, or where principal moments are equal or nearly so, vertices to vertices; all "
    "symmetric cases are tried, also mirrored ones. The motion found is checked on the whole of both boundaries, with "
    "doubles: a tolerance below 2^-36 of the size of the solids or 2^-48 of their coordinates is raised to that. So "
    "moved and rounded copies are found; of solids that are alike only within a coarse tolerance the motion may be "
    "missed.";

const std::string kBrick = "(createCube (makePoint3D 0 0 0) (makePoint3D 1 2 4))";
const std::string kTurnedBrick = "(createCube (makePoint3D 10 0 0) (makePoint3D 12 1 4))";
const std::string kLongerBrick = "(createCube (makePoint3D 0 0 0) (makePoint3D 1 2 5))";

}  // namespace

void register_congruence(OperatorGroup& group) {
  group.add({
      .name = "isCongruent",
      .syntax = "isCongruent(_, _, _)",
      .doc = "True if two solids are equal up to a rigid motion, also a mirrored one, within a tolerance.",
      .detail =
          std::string(kMeaningOfCongruence) +
          " Two empty solids are congruent, an empty one and another are not. False if the tolerance is negative.",
      .exactness = Exactness::not_numeric,
      .overloads = {overload<&are_congruent>("a", "b", "tolerance")},
      .examples = {{{kBrick, kTurnedBrick, "1e-9"}, "TRUE"},
                   {{kBrick, kLongerBrick, "1e-9"}, "FALSE"},
                   {{"(volume3d ())", "(volume3d ())", "0"}, "TRUE"},
                   {{kBrick, kUndefinedSolid, "0"}, "undefined"}},
      .errors = {{{kBrick, kBrick}, "isCongruent: expected (volume3d volume3d real), got (volume3d volume3d)"}},
  });
  group.add({
      .name = "congruence",
      .syntax = "congruence(_, _, _)",
      .doc = "The motion that carries one solid onto another within a tolerance, in one row (Centre: point3d, Axis: "
             "vector3d, Angle: real, Translation: vector3d, Mirrored: bool); no row if none is found.",
      .detail = std::string(
                    "If Mirrored, first the reflection at the point Centre, the centre of mass of the first "
                    "solid; then the rotation about the line through Centre along Axis by Angle degrees, right-handed; "
                    "then the translation. A motion that is not mirrored is preferred, then one with a small angle. "
                    "The numbers are rounded. ") +
                kMeaningOfCongruence + " No row if a solid is empty.",
      .exactness = Exactness::not_numeric,
      .frame_use = FrameUse::axes,
      .overloads = {table<&congruence_row>({"Centre", "Axis", "Angle", "Translation", "Mirrored"}, "a", "b",
                                           "tolerance")},
      .examples = {{{kBrick, "(createCube (makePoint3D 5 5 5) (makePoint3D 6 7 9))", "1e-9"},
                    "(((0.5 1.0 2.0) (1.0 0.0 0.0) 0.0 (5.0 5.0 5.0) FALSE))"},
                   {{kBrick, kLongerBrick, "1e-9"}, "()"},
                   {{kBrick, kUndefinedSolid, "0"}, "()"}},
      .errors = {{{kBrick, kBrick}, "congruence: expected (volume3d volume3d real), got (volume3d volume3d)"}},
  });
}

}  // namespace algebra3d
