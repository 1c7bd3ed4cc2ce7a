#pragma once

#include "algebra3d/repair/facet_list.h"
#include "algebra3d/repair/repair_report.h"

namespace algebra3d {

/// Drops fins: what hangs together across edges of two facets, ends in the open somewhere, and hangs on others, which
/// balance without it along every edge that they have in common, and have more area together at each. Requires oriented
/// facets. Exact. Cost: linear, and that of the edges of more than two facets for each round in which something is
/// dropped.
void drop_fins(FacetList& facets, RepairReport& report);

}  // namespace algebra3d
