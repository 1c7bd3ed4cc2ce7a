#pragma once

#include "algebra3d/repair/facet_list.h"
#include "algebra3d/repair/repair_report.h"

namespace algebra3d {

/// Turns facets over so that those on both sides of an edge of two facets agree, as far as that is possible (not round
/// a Moebius strip): of what hangs together across such edges, the side that has more area stays as it is. Then turns
/// over whole parts, as long as the edges of more than two facets become more nearly balanced by that.
/// Decisions: by areas and lengths, rounded; the result does not depend on the order of anything else. Cost: linear,
/// and a few passes over the edges of more than two facets.
void orient_facets(FacetList& facets, RepairReport& report);

}  // namespace algebra3d
