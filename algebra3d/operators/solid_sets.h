#pragma once

#include <span>

#include "algebra3d/arrangement/surface_arrangement.h"
#include "algebra3d/base/context.h"
#include "algebra3d/base/error.h"
#include "algebra3d/types/spatial.h"

namespace algebra3d {

// Set operations on solids (regularised) and surfaces as values: language.md 7.3. All are exact for all operands;
// errors are `interrupted` and `limit_exceeded`.

/// Of any number of solids in one arrangement; the empty solid for none.
Result<Volume3d> united(Context& context, std::span<const Volume3d> solids);
/// Of at least one solid.
Result<Volume3d> intersected(Context& context, std::span<const Volume3d> solids);
Result<Volume3d> without(Context& context, const Volume3d& solid, const Volume3d& other);
Result<Volume3d> in_either(Context& context, const Volume3d& solid, const Volume3d& other);

/// On surfaces: triangles are divided at one another, and whole pieces are kept (language.md 7.3).
Result<Surface3d> combined(Context& context, const Surface3d& a, const Surface3d& b, SurfaceRule rule);

/// The parts of a solid on both sides of a plane; either may be empty.
struct SolidParts {
  Volume3d in_front, behind;
};
Result<SolidParts> split(Context& context, const Volume3d& solid, const ExactPlane& plane);
/// The part of the plane that lies in the solid, without lower-dimensional left-overs; its front is that of the plane.
Result<Surface3d> section(Context& context, const Volume3d& solid, const ExactPlane& plane);
/// The part of the solid in the box.
Result<Volume3d> clipped(Context& context, const Volume3d& solid, const Box3& box);

}  // namespace algebra3d
