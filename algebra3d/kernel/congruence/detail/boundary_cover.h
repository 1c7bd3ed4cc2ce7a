#pragma once

#include <array>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/congruence/detail/centred_solid.h"
#include "algebra3d/kernel/congruence/detail/face_lookup.h"
#include "algebra3d/kernel/congruence/detail/rotation.h"

namespace algebra3d::detail {

/// True if every point of the boundary of `solid`, turned by `rotation` about its centre, is within `tolerance` of the
/// boundary of `other`, both with their centres at the origin. Computed with doubles: the tolerance must be far above
/// their rounding. Errors: interrupted. Cost: constant for each triangle that the other boundary has, too, as a copy
/// does; that of the pairs of triangles near each other for the others; ends at the first point found farther away.
///
/// The points of a triangle that are within the tolerance of another one form a convex set. So a convex piece is near
/// if its corners are near one triangle. Other triangles are divided at the edges of the triangles of the other
/// boundary.
Result<bool> is_boundary_near(const CentredSolid& solid, const Rotation& rotation, const CentredSolid& other,
                              const FaceLookup& faces_of_other, double tolerance, const Monitor& monitor);

}  // namespace algebra3d::detail
