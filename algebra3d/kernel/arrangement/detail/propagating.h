#pragma once

#include "algebra3d/kernel/arrangement/detail/classification.h"
#include "algebra3d/kernel/arrangement/detail/seeding.h"

namespace algebra3d::arrangement {

/// Step 3 of stage 8: gives every front winding: that of the representative of its set plus the difference. Front
/// windings of sets that were not seeded are 0 and mean nothing. Cost: near-linear.
Classification propagate_windings(const Subdivision& subdivision, LinkedWindings& linked, const SetWindings& known);

}  // namespace algebra3d::arrangement
