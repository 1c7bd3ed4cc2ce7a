#pragma once

#include "algebra3d/arrangement/arrangement.h"
#include "algebra3d/arrangement/operand.h"
#include "algebra3d/repair/repair_options.h"

namespace algebra3d {

/// Converts the work limit to limits of an arrangement: a number of pairs of triangles, and a number of cuts, each of
/// which counts as a thousand pairs.
ArrangementOptions work_limits(const RepairOptions& options);

}  // namespace algebra3d
