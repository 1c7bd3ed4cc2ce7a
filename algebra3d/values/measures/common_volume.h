#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/exact/rational.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {

/// The volume that two solids have in common, in cubed coordinate units. Exact. Errors: interrupted, limit_exceeded.
/// Cost: that of the intersection of the solids if they overlap; if not, that of their relation, and of the volume of
/// one of them if it is inside the other.
Result<Rational> common_volume(const Volume3d& a, const Volume3d& b, const Monitor& monitor = {});

}  // namespace algebra3d
