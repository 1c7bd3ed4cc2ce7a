#pragma once

#include <vector>

#include "algebra3d/kernel/repair/detail/edge_splits.h"

namespace algebra3d {

/// Selects the splits that stitch edges: each part of a split edge must meet exactly one other boundary edge, or part
/// of one, in the opposite direction. The others are dropped: they would close nothing, and would cut up the boundaries
/// of holes as thin as the tolerance. Cost: n log n in the boundary edges per round.
std::vector<EdgeSplit> splits_that_stitch(const IndexedSoup& soup, std::vector<EdgeSplit> splits);

}  // namespace algebra3d
