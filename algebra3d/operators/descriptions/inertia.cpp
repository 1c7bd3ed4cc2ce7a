// inertia: mass properties of solids.
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "algebra3d/kernel/exact/nearest_mass_properties.h"
#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// Undefined beyond the range of doubles.
using Moment = std::optional<double>;
using InertiaRow = std::tuple<Moment, Point3d, Moment, Moment, Moment, Moment, Moment, Moment, Moment, Moment, Moment,
                              Vector3d, Vector3d, Vector3d>;

Moment moment(double value) {
  return std::isfinite(value) ? Moment(value) : std::nullopt;
}
Vector3d direction(const Vec3& axis) {
  return {ExactPoint(axis)};
}

Result<Maybe<InertiaRow>> inertia_of(Context& context, const Volume3d& solid) {
  if (solid.mesh().is_empty()) return Maybe<InertiaRow>(Undefined{"an empty solid has no inertia"});
  A3D_ASSIGN(const NearestMassProperties mass,
             nearest_mass_properties(solid.mesh().points(), triangles_of(solid.mesh()), context.cancel));
  const auto& [xx, yy, zz, yz, zx, xy] = mass.inertia;
  const auto& [values, axes, are_equal] = mass.principal;
  // The centre of mass lies in the box of the solid, so its coordinates are finite.
  return Maybe<InertiaRow>(InertiaRow(moment(mass.volume), Point3d{ExactPoint(mass.centre)}, moment(xx), moment(yy),
                                      moment(zz), moment(yz), moment(zx), moment(xy), moment(values[0]),
                                      moment(values[1]), moment(values[2]), direction(axes[0]), direction(axes[1]),
                                      direction(axes[2])));
}

}  // namespace

void register_inertia(OperatorGroup& group) {
  group.add({
      .name = "inertia",
      .syntax = "inertia(_)",
      .doc = "Volume, centre of mass and moments of inertia of a solid of density 1, in one row (Volume: real, Centre: "
             "point3d, Ixx, Iyy, Izz, Iyz, Izx, Ixy: real, Moment1, Moment2, Moment3: real, Axis1, Axis2, Axis3: "
             "vector3d).",
      .detail =
          "Ixx to Ixy are the entries of the inertia tensor about the centre of mass, so Ixy is minus the integral of "
          "xy. "
          "Its eigenvalues are the principal moments, ascending, its unit eigenvectors the principal axes, which form "
          "a "
          "right-handed system. Numbers are the exact ones, rounded once; components of axes are within 2^-50. The "
          "sign of "
          "Axis1 and Axis2 is that for which the first component beyond 0.57 is positive. Where moments are equal, "
          "exactly, their first axis is a coordinate axis, projected: that at the greatest angle to the third axis. No "
          "row for the empty solid; numbers beyond the range of doubles are undefined.",
      .exactness = Exactness::rounded_once,
      .frame_use = FrameUse::axes,
      .sources = {"lien1984"},
      .overloads = {table<&inertia_of>({"Volume", "Centre", "Ixx", "Iyy", "Izz", "Iyz", "Izx", "Ixy", "Moment1",
                                        "Moment2", "Moment3", "Axis1", "Axis2", "Axis3"},
                                       "solid")},
      // V/12 (b^2 + c^2) with sides 2, 4 and 6.
      .examples = {{{"(createCube (makePoint3D 0 0 0) (makePoint3D 2 4 6))"},
                    "((48.0 (1.0 2.0 3.0) 208.0 160.0 80.0 0.0 0.0 0.0 80.0 160.0 208.0 (0.0 0.0 1.0) (0.0 1.0 0.0) "
                    "(-1.0 0.0 0.0)))"},
                   {{"(volume3d ())"}, "()"},
                   {{kUndefinedSolid}, "()"}},
      .errors = {{{kOrigin}, "inertia: expected (volume3d), got (point3d)"}},
  });
}

}  // namespace algebra3d
