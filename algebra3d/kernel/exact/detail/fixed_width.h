#pragma once

#include <array>

#include "algebra3d/kernel/exact/detail/homogeneous.h"

namespace algebra3d::detail {

// Constructions from doubles in integers of fixed size, a fifth of the time of GMP's numbers. They need the coordinates
// on each axis to be integers below 2^60 times one power of two (predicates_integers.h), as those of models nearly
// always are. All return false, and leave the result alone, if they are not.

/// The plane through three points, as `join` (homogeneous.h) gives it, up to a power of two in common.
bool join_in_fixed_width(HomogeneousPoint& result, const std::array<Vec3, 3>& points);

/// The point where the line through a and b meets the plane of a triangle, without a power of two in common. They must
/// not be parallel.
bool meet_in_fixed_width(HomogeneousPoint& result, const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& triangle);

}  // namespace algebra3d::detail
