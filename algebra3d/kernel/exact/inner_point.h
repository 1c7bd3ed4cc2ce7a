#pragma once

#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d {

/// A point in the interior of a triangle that is not degenerate. The points of different attempts are different, so of
/// the finitely many places at which something else touches the triangle each is met by one of them at most. `attempt`:
/// 0 to 50. Exact: the weights have a power of two as their sum, so the point of a triangle with short coordinates
/// consists of doubles, which are fast.
ExactPoint inner_point(const TriangleRef& triangle, int attempt);

}  // namespace algebra3d
