#pragma once

#include <cstddef>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/arrangement/detail/segment_complex.h"

namespace algebra3d::arrangement {

/// Stage 5: adds to a complex of find_facet_contacts the cuts of the segments of each plane at one another: where they
/// cross, where one ends on another, where two are collinear and overlap, and where one leads through a node at which
/// another facet touches the plane. Where a common part meets the boundary of one of its two facets, stage 4 has cut
/// already. The cuts of the result are sorted, without repetitions, and no more nodes can be added. Exact. Errors:
/// interrupted; limit_exceeded beyond `max_cuts` cuts. Cost: n log n in the segments of a plane and their crossings.
Result<SegmentComplex> overlay(const Operands& operands, const Facets& facets, SegmentComplex complex,
                               const Monitor& monitor, std::size_t max_cuts = SIZE_MAX);

}  // namespace algebra3d::arrangement
