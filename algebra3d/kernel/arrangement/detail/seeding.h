#pragma once

#include <map>

#include "algebra3d/kernel/arrangement/detail/linking.h"
#include "algebra3d/kernel/arrangement/detail/operands.h"
#include "algebra3d/kernel/arrangement/winding_vector.h"

namespace algebra3d::arrangement {

/// Per set, by its representative (WindingSets::Position): the windings of the representative, as far as they are
/// known.
using SetWindings = std::map<FrontWindingId, WindingVector>;

/// Step 2 of stage 8: finds the windings of each set at one place of it: from the faces there if each operand is closed
/// alone, else from the cell above. In the first case sets that many operands may surround are linked to each other
/// before. Gives the windings of the representatives of all sets that have a jump or a patch. Exact. Errors:
/// interrupted. Cost: an upward ray for each set and each operand near to it that has no face there.
Result<SetWindings> seed_windings(const Subdivision& subdivision, const WindingJumps& jumps, LinkedWindings& linked,
                                  Closure closure, const Monitor& monitor);

}  // namespace algebra3d::arrangement
