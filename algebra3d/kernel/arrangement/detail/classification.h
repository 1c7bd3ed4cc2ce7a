#pragma once

#include <string>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/arrangement/detail/subdivision.h"
#include "algebra3d/kernel/arrangement/detail/winding_jumps.h"
#include "algebra3d/kernel/arrangement/operand.h"

namespace algebra3d::arrangement {

/// Output of stage 8: the windings in front of everything that may bound a result.
struct Classification {
  /// The windings in front of the plane, at the sub-facet on each side of each sub-edge. Meaningless where the winding
  /// jump is zero: nothing bounds a result there.
  CompactWindings<SubEdgeSide> at_sides;
  /// The windings in front of the faces of each patch.
  IdVector<PatchId, WindingVector> at_patches;
};

/// The rest of stage 8, after the winding jumps, in three steps (docs/set-operations.md): *linking* unites front
/// windings whose differences are known (linking.h), so that each connected component is known up to a constant;
/// *seeding* finds this constant at one place of each (seeding.h); *propagating* adds it to all others (propagating.h).
/// Exact. Errors: interrupted; internal as link_windings.
Result<Classification> classify(const Subdivision& subdivision, const WindingJumps& jumps, Closure closure,
                                const Monitor& monitor);

/// Every violated invariant, one sentence each: neighbours in a radial order agree on the cell between them; patches at
/// an uncut edge agree; if each operand is closed alone, no cell has less than none or more than all of a group.
/// Cost: n log n, with exact predicates.
std::vector<std::string> audit(const Subdivision& subdivision, const WindingJumps& jumps, Closure closure,
                               const Classification& classification);

}  // namespace algebra3d::arrangement
