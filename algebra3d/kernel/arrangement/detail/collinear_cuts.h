#pragma once

#include <vector>

#include "algebra3d/kernel/arrangement/detail/segment_complex.h"

namespace algebra3d::arrangement {

/// Adds a cut of the segment at the node, if the node lies inside the segment. The node must lie on the segment's line.
void cut_if_inside(const SegmentComplex& complex, SegmentId segment, NodeId node, std::vector<Cut>& cuts);

/// Cuts collinear segments at each other's ends and cuts, whichever plane has found these. Cost: n log n.
void share_cuts(SegmentComplex& complex);

}  // namespace algebra3d::arrangement
