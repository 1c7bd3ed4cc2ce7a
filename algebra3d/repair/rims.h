#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/repair/facet_list.h"
#include "algebra3d/repair/repair_report.h"

namespace algebra3d {

/// Closes holes whose rim runs along edges of more than two facets in part, of which more run one way than the other:
/// what boundaries and such edges lack to balance are closed loops always, and each that has edges of both kinds and
/// whose box has a diameter up to `largest` is covered with triangles, shortest loops first found. Loops of boundary
/// edges alone are those of `close_holes`, loops without them the rims of inner walls; both stay.
/// Requires oriented facets. The distance in the report is that of `close_holes`. Errors: interrupted.
/// Cost: linear, and that of the loops.
Status close_rims(FacetList& facets, double largest, RepairReport& report, const Monitor& monitor = {});

}  // namespace algebra3d
