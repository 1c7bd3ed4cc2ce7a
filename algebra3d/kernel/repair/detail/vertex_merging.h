#pragma once

#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "algebra3d/kernel/repair/repair_report.h"

namespace algebra3d {

/// Merges boundary vertices no farther apart than the tolerance (in coordinate units), nearest pairs first. A pair
/// farther apart than a third of a boundary edge at one of the two is left out. Vertices that pairs connect become one,
/// as far as each is within the tolerance of the one with the lowest index, which does not move. Corners of one
/// triangle are never merged, also by way of others, so no edge vanishes. Reported as gaps. Decisions: by rounded
/// distances. Cost: n log n in the boundary edges.
void merge_boundary_vertices(IndexedSoup& soup, double tolerance, RepairReport& report);

}  // namespace algebra3d
