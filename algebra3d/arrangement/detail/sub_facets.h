#pragma once

#include "algebra3d/arrangement/detail/subdivision.h"
#include "algebra3d/arrangement/detail/winding_sets.h"

namespace algebra3d::arrangement {

/// Unites the front windings at sides of sub-edges that bound one sub-facet, as far as they follow each other round a
/// node: neighbours in the angular order of the sub-edges of a plane at a node share the sub-facet between them. The
/// side of a hole is not united with that of the outer boundary; it is linked through other planes, or its set is
/// seeded by itself. Sides without a facet are left alone. Exact. Errors: internal, if a facet covers one of two
/// neighbouring sides only, which complete incident facets rule out. Cost: n log n.
Status join_sub_facets(const Subdivision& subdivision, WindingSets& windings);

}  // namespace algebra3d::arrangement
