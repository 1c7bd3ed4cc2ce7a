#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/repair/facet_list.h"
#include "algebra3d/repair/repair_report.h"

namespace algebra3d {

struct HoleLimits {
  double largest;            ///< the diameter of the box around a hole
  bool drops_sheets = true;  ///< that lie beside something else
};

/// Covers each closed loop of boundary edges whose box has a diameter up to the largest with triangles (see
/// loop_triangulation.h) that look the way their neighbours do: those that bend the surface least or, if these would
/// cut it, those with the least area; if both do, the first, and what they cut is divided later. What hangs together
/// across edges is left open if it has one loop, and what covers that cuts it or lies upon it and has more than 3/4 of
/// its area: that is no solid with a hole, but a sheet, and is dropped unless there is nothing else. Requires oriented
/// facets. The distance in the report is no smaller than that of any new point from the loop. Errors: interrupted.
/// Cost: linear, and that of the loops.
Status close_holes(FacetList& facets, const HoleLimits& limits, RepairReport& report, const Monitor& monitor = {});

}  // namespace algebra3d
