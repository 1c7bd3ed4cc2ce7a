#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/repair/facet_list.h"
#include "algebra3d/repair/repair_report.h"

namespace algebra3d {

/// Joins pairs of closed boundary loops that run close to each other, as the rim of a body and that of a lid above it,
/// by a band of triangles between them, where that has less than half the area of what would close both, and is not
/// folded back upon the surface. Of two parts that look different ways the smaller one is turned over. Pairs whose box
/// has a diameter above the largest stay. Requires oriented facets. True if there is any band. The distance in the
/// report is no smaller than that of any new point from the loops. Errors: interrupted. Cost: linear, n log n in the
/// loops, n * m for loops of n and m corners. Deterministic.
Result<bool> close_bands(FacetList& facets, double largest, RepairReport& report, const Monitor& monitor = {});

}  // namespace algebra3d
