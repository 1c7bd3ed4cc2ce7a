#pragma once

#include <cstdint>

#include "algebra3d/kernel/arrangement/arrangement.h"
#include "algebra3d/kernel/arrangement/operand.h"
#include "algebra3d/kernel/repair/repair_options.h"

namespace algebra3d {

/// The options of an arrangement within the work limit: at most so many pairs of triangles, and at most a thousandth as
/// many cuts; Closure::together, as ValidParts need it. The limit of solid angles is applied apart
/// (solid_by_generalized_winding).
ArrangementOptions work_limits(const RepairOptions& options);

/// The limit of the work with long numbers in the proof of a result (exact_work.h): a product of limbs for each
/// pair of triangles.
std::uint64_t exact_work_limit(const RepairOptions& options);

}  // namespace algebra3d
