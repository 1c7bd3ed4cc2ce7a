#pragma once

#include "algebra3d/base/monitor.h"

namespace algebra3d {

class FacetOutlines;

/// Notes that chains are to be routed through points which they may have passed over when their ends moved: corners of
/// a facet along the chain that are no farther from it than the chain and the corner together may have moved. Requires
/// straight chains. If `monitor` is cancelled, some are left out. Cost: n log n.
void route_through_passed_points(FacetOutlines& outlines, const Monitor& monitor);

}  // namespace algebra3d
