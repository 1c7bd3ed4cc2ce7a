#pragma once

#include <array>
#include <atomic>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/exact/principal_axes.h"

namespace algebra3d {

/// A solid of density 1: volume, centre of mass, and the inertia tensor about that centre.
struct MassProperties {
  Rational volume;
  RationalVec3 centre;
  SymmetricMatrix inertia;
};

/// Mass properties of a solid given by its boundary, which must enclose a positive volume. Exact. Errors: interrupted.
/// Cost: linear, about four times that of `exact_volume`.
Result<MassProperties> mass_properties(const PointArray& points, IndexTriangles triangles,
                                       const std::atomic<bool>* cancel = nullptr);

}  // namespace algebra3d
