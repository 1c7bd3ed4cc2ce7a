#pragma once

#include "algebra3d/arrangement/arrangement.h"
#include "algebra3d/repair/repair_options.h"

namespace algebra3d {

/// The work limit as pairs of triangles, and as cuts of triangles at each other, of which one is as much work as a
/// thousand pairs.
ArrangementOptions work_limits(const RepairOptions& options);

}  // namespace algebra3d
