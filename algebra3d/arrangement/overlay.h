#pragma once

#include "algebra3d/arrangement/skeleton.h"
#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"

namespace algebra3d::arrangement {

/// Cuts the segments of each plane at one another: where they cross, where one ends on another, where two lie on one
/// line, and where a facet is touched on one. What a facet's own boundary and its common parts with other facets have
/// in common is cut already. Errors: interrupted.
Status cut_segments(Skeleton& skeleton, const Monitor& monitor);

}  // namespace algebra3d::arrangement
