#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/repair/facet_list.h"
#include "algebra3d/repair/repair_report.h"

namespace algebra3d {

struct RimLimits {
  double largest;                ///< the diameter of the box around a loop
  bool covers_walls = false;     ///< loops without a boundary edge, too: the rims of inner walls
  bool takes_shortcuts = false;  ///< loops may run along edges that lack nothing, between ends of those that do
};

/// Closes holes whose rim runs along edges of more than two facets in part, of which more run one way than the other:
/// what boundaries and such edges lack to balance are closed loops always, and each that has edges of both kinds and
/// whose box has a diameter up to the largest is covered with triangles, shortest loops first found. Boundaries that
/// are no loops by themselves, as each ends at an inner wall, may be one together: it is covered if that takes less
/// area. Closed boundaries are those of `close_holes`, loops without boundary edges the rims of inner walls; both stay,
/// unless the latter are to be covered: every edge balances then. With shortcuts, the strip that a cap over an inner
/// wall lacks is covered, and not the whole rim of the wall with it. Requires oriented facets. The distance in the
/// report is the diameter of the loop. Errors: interrupted. Cost: linear, and that of the loops.
Status close_rims(FacetList& facets, const RimLimits& limits, RepairReport& report, const Monitor& monitor = {});

}  // namespace algebra3d
