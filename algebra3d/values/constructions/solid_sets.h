#pragma once

#include <span>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/arrangement/surface_arrangement.h"
#include "algebra3d/values/types/spatial.h"
#include "base/context.h"

namespace algebra3d {

// Set operations on values: regularised on solids, and on surfaces (docs/set-operations.md). All are exact for all
// operands; errors are `interrupted` and `limit_exceeded`.

/// The union of any number of solids (divide_and_conquer.h); the empty solid for none.
Result<Volume3d> united(Context& context, std::span<const Volume3d> solids);
/// The intersection of at least one solid.
Result<Volume3d> intersected(Context& context, std::span<const Volume3d> solids);
/// The difference of two solids.
Result<Volume3d> without(Context& context, const Volume3d& solid, const Volume3d& other);
/// The symmetric difference of two solids.
Result<Volume3d> in_either(Context& context, const Volume3d& solid, const Volume3d& other);

/// A set operation on surfaces: triangles are divided at one another, and their parts are selected
/// (docs/set-operations.md, "Surfaces").
Result<Surface3d> combined(Context& context, const Surface3d& a, const Surface3d& b, SurfaceRule rule);

/// The parts of a solid on both sides of a plane; either may be empty.
struct SolidParts {
  Volume3d in_front, behind;
};
Result<SolidParts> split(Context& context, const Volume3d& solid, const ExactPlane& plane);
/// The part of the plane inside the solid, without parts of lower dimension; its front is that of the plane.
Result<Surface3d> section(Context& context, const Volume3d& solid, const ExactPlane& plane);
/// The part of the solid in the box.
Result<Volume3d> clipped(Context& context, const Volume3d& solid, const Box3& box);

}  // namespace algebra3d
