#pragma once

#include <vector>

#include "algebra3d/arrangement/detail/patches.h"
#include "algebra3d/arrangement/detail/sub_edges.h"

namespace algebra3d::arrangement {

/// An uncut edge: an edge of an operand between a patch and a facet. No other operand touches it. Its own operand may,
/// with a corner or an edge; then it is divided into several space edges. The patch has it whole, so every result that
/// takes the patch has, too.
struct UncutEdge {
  SegmentId segment;
  InputEdgeId edge;
};

/// All uncut edges, in the order of their segments. Cost: linear in the segments.
std::vector<UncutEdge> uncut_edges(const Operands& operands, const SegmentComplex& complex, const Patches& patches);

/// The space edges along uncut edges, ascending. These are where patches end.
std::vector<SpaceEdge> space_edges_of(const std::vector<UncutEdge>& uncut_edges, const SubEdges& sub_edges);

}  // namespace algebra3d::arrangement
