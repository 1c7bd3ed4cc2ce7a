#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/rounding/detail/rounding_job.h"

namespace algebra3d {

// The ladder of methods (docs/set-operations.md, "Rounding of solids") without the cover of cubes. Errors: interrupted,
// limit_exceeded.

/// Climbs the rungs that a part of a solid is enough for, until the job accepts a candidate; false if it accepts none.
Result<bool> round_part(RoundingJob& job);
/// Climbs all rungs with the whole mesh.
Result<bool> round_whole(RoundingJob& job);

}  // namespace algebra3d
