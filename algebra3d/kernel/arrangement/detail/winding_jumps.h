#pragma once

#include <string>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/compact_windings.h"
#include "algebra3d/kernel/arrangement/detail/sub_edges.h"
#include "algebra3d/kernel/arrangement/detail/subdivision.h"
#include "algebra3d/kernel/arrangement/winding_vector.h"

namespace algebra3d::arrangement {

/// Winding jumps: by how much the windings of the cell behind the plane (Plane, facets.h) exceed those of the cell in
/// front of it, at the sub-facet on each side of each sub-edge. Opposite contributions of facets of one group cancel
/// out.
using WindingJumps = CompactWindings<SubEdgeSide>;

/// The beginning of stage 8: the winding jumps of all sides, from the incident facets. Cost: linear.
WindingJumps winding_jumps(const Operands& operands, const Facets& facets, const SubEdges& sub_edges);

/// Every violated invariant, one sentence each: each side has a jump; no jump is larger than the number of facets of
/// its group there, and both are even or both odd; round a space edge that is not on an uncut edge, the jumps add up to
/// nothing. Cost: n log n.
std::vector<std::string> audit(const Subdivision& subdivision, const WindingJumps& jumps);

}  // namespace algebra3d::arrangement
