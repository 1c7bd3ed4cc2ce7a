#pragma once

#include <array>
#include <atomic>

#include "algebra3d/base/error.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/exact/mass_properties.h"
#include "algebra3d/kernel/exact/principal_axes.h"

namespace algebra3d {

/// Mass properties of a solid of density 1, rounded.
struct NearestMassProperties {
  double volume = 0;
  Vec3 centre;
  std::array<double, 6> inertia{};  ///< xx, yy, zz, yz, zx, xy
  PrincipalAxes principal;
};

/// `mass_properties` and the principal axes of the tensor. Exactness: numbers are the exact ones, rounded to nearest,
/// and infinite beyond the range of doubles; axes as those of `principal_axes`. Errors: interrupted. Cost: linear;
/// where corners are not doubles about that of `nearest_volume`, since coordinates that are cut off and a bound of the
/// change nearly always decide. If they do not (an entry that is exactly 0, moments that are exactly equal), that of
/// `mass_properties` (counted in `exact_counters().filter_failures`).
Result<NearestMassProperties> nearest_mass_properties(const PointArray& points, IndexTriangles triangles,
                                                      const std::atomic<bool>* cancel = nullptr);

/// `mass_properties` off by less than 2^-80 of the volume, of the size of the solid, and of the trace of the tensor,
/// which is positive definite. Exact where all corners are doubles. Errors: interrupted. Cost: as above.
Result<MassProperties> approximate_mass_properties(const PointArray& points, IndexTriangles triangles,
                                                   const std::atomic<bool>* cancel = nullptr);

}  // namespace algebra3d
