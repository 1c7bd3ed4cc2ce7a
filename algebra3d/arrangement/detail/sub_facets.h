#pragma once

#include <vector>

#include "algebra3d/arrangement/detail/subdivision.h"
#include "algebra3d/base/error.h"

namespace algebra3d::arrangement {

/// Two sides of sub-edges that bound one sub-facet.
struct NeighbouringSides {
  SubEdgeSide first, second;
};

/// The sides of sub-edges that bound one sub-facet and follow each other round a node: neighbours in the angular order
/// of the sub-edges of a plane at a node share the sub-facet between them. The side of a hole is not paired with one of
/// the outer boundary; it is linked through other planes, or its set is seeded by itself. Sides without a facet are
/// left out. Exact. Errors: internal, if a facet covers one of two neighbouring sides only, which complete incident
/// facets rule out. Cost: n log n.
Result<std::vector<NeighbouringSides>> neighbouring_sides(const Subdivision& subdivision);

}  // namespace algebra3d::arrangement
