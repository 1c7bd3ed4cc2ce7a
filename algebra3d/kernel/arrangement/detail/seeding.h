#pragma once

#include "algebra3d/kernel/arrangement/detail/upward_linking.h"

namespace algebra3d::arrangement {

/// Step 2 of stage 8: finds the windings of each set at one place of it, by seed_from_faces.h if each operand is closed
/// alone, else by seed_from_above.h. In the first case sets that many operands may surround are linked to each other
/// before (upward_linking.h). Gives the windings of the representatives of all sets that have a jump or a patch. Exact.
/// Errors: interrupted. Cost: an upward ray for each set and each operand near to it that has no face there.
Result<SetWindings> seed_windings(const Subdivision& subdivision, const WindingJumps& jumps, LinkedWindings& linked,
                                  Closure closure, const Monitor& monitor);

}  // namespace algebra3d::arrangement
