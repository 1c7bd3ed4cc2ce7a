#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/rounding/detail/rounding_job.h"

namespace algebra3d {

/// Climbs the ladder of rounding (the table in rounding_ladder.cpp, in words `rounding_rungs`), until the job accepts a
/// candidate that no further rung may better. False if it accepts none: a part of a solid needs rungs for which the
/// whole must be given, or the grid has no numbers beyond the mesh. Errors: interrupted, limit_exceeded.
Result<bool> climb_ladder(RoundingJob& job);

}  // namespace algebra3d
