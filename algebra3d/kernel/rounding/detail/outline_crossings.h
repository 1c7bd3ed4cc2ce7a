#pragma once

#include <vector>

#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/rounding/detail/facet_outlines.h"

namespace algebra3d {

/// For every two links of one outline that cross or touch: notes that one of them is to be routed through the nearest
/// end of the other. Returns the facets of which a link would have to lead too far aside: their outlines are to be
/// given up. If `monitor` is cancelled, some are left out. Cost: n log n in the links.
std::vector<CoplanarFacetId> resolve_crossings(FacetOutlines& outlines, const std::vector<OutlineLink>& links,
                                               const Monitor& monitor);

}  // namespace algebra3d
