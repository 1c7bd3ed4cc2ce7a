#pragma once

#include "algebra3d/repair/detail/indexed_soup.h"
#include "algebra3d/repair/repair_report.h"

namespace algebra3d {

/// Merges boundary vertices no farther apart than the tolerance, nearest first. The vertex with the lowest index does
/// not move. Corners of one triangle are never merged, nor vertices farther apart than a third of a boundary edge at
/// one of them; so no triangle vanishes. Reported as gaps. Decisions: by rounded distances. Cost: n log n in the
/// boundary edges.
void merge_boundary_vertices(IndexedSoup& soup, double tolerance, RepairReport& report);

}  // namespace algebra3d
