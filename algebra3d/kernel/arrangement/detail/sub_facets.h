#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/arrangement/detail/front_winding_ids.h"
#include "algebra3d/kernel/arrangement/detail/subdivision.h"

namespace algebra3d::arrangement {

/// Numbers the front windings. The sides of sub-edges that bound one sub-facet follow each other round nodes:
/// neighbours in the angular order of the sub-edges of a plane at a node share the sub-facet between them. So sides
/// form closed chains, each with one front winding. A hole is a chain of its own, apart from the outer boundary; it is
/// linked through other planes, or its set is seeded by itself. Exact. Errors: internal, if a facet covers one of two
/// neighbouring sides only, which complete incident facets rule out. Cost: n log n, plane by plane in parallel.
Result<FrontWindingIds> number_front_windings(const Subdivision& subdivision);

}  // namespace algebra3d::arrangement
