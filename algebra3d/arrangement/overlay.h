#pragma once

#include <cstddef>
#include <cstdint>

#include "algebra3d/arrangement/skeleton.h"
#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"

namespace algebra3d::arrangement {

/// Cuts the segments of each plane at one another: where they cross, where one ends on another, where two lie on one
/// line, and where a facet is touched on one. What a facet's own boundary and its common parts with other facets have
/// in common is cut already. Errors: interrupted; limit_exceeded
/// beyond `max_cuts` of them.
Status cut_segments(Skeleton& skeleton, const Monitor& monitor, std::size_t max_cuts = SIZE_MAX);

}  // namespace algebra3d::arrangement
