#pragma once

#include <optional>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/distance/farthest_point.h"
#include "algebra3d/values/spatial_relations/relation.h"

namespace algebra3d {

/// The Hausdorff distance of two sets, of solids and boxes that of their boundaries: how far a point of one can be from
/// the other, whichever is farther. The point that is farthest, with its exact distance and an upper bound of all
/// (farthest_point.h); nothing if a set is empty. Errors: interrupted. Cost: as of farthest_point.
Result<std::optional<FarthestPoint>> hausdorff_distance(const SpatialSet& a, const SpatialSet& b,
                                                        const Monitor& monitor = {});

}  // namespace algebra3d
