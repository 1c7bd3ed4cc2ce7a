#pragma once

#include "algebra3d/arrangement/arrangement.h"
#include "algebra3d/arrangement/operand.h"
#include "algebra3d/repair/repair_options.h"

namespace algebra3d {

/// The options of an arrangement within the work limit: at most so many pairs of triangles, and at most a thousandth as
/// many cuts; Closure::together, as ValidParts need it. The limit of solid angles is applied apart
/// (solid_by_generalized_winding).
ArrangementOptions work_limits(const RepairOptions& options);

}  // namespace algebra3d
