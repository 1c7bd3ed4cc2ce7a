#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/subdivision.h"
#include "algebra3d/kernel/arrangement/detail/winding_jumps.h"
#include "algebra3d/kernel/arrangement/detail/winding_sets.h"

namespace algebra3d::arrangement {

/// A place at which seeding can find the windings of one of the LinkedWindings::sets: a space edge at which facets
/// meet, and one half-plane there. The set is the one with the front winding of the half-plane.
struct SeedPlace {
  IdRange<SubEdgeId> sub_edges;  ///< all along the space edge
  SubEdgeSide half_plane;        ///< one with a jump
  /// The number of operands with a face there: where each operand is closed alone, only the others need rays.
  std::uint32_t operand_count;
};

/// Output of linking: front windings, known up to one constant for each set.
struct LinkedWindings {
  FrontWindingIds ids;
  WindingSets sets;
  /// One for each set with a jump at a space edge that is on no uncut edge: the first one with the most operands.
  std::vector<SeedPlace> seeds;
};

/// Step 1 of stage 8: unites front windings whose difference is known. The sides of sub-edges
/// round a sub-facet have one front winding (sub_facets.h); round each space edge, the radial order of the half-planes
/// with jumps says how windings change from cell to cell; at uncut edges windings go on into patches. Exact. Errors:
/// internal as number_front_windings. Cost: n log n.
Result<LinkedWindings> link_windings(const Subdivision& subdivision, const WindingJumps& jumps);

/// Every violated invariant, one sentence each: the sets have all front windings, and each side with a jump has one;
/// half-planes with jumps that follow each other round a space edge are in one set, and agree on the cell between them;
/// so do patches at an uncut edge; seeds are at space edges, each with a half-plane of its own that has a jump, and an
/// operand. Cost: n log n, with exact predicates.
std::vector<std::string> audit(const Subdivision& subdivision, const WindingJumps& jumps, const LinkedWindings& linked);

}  // namespace algebra3d::arrangement
