#pragma once

#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "algebra3d/kernel/repair/repair_report.h"

namespace algebra3d {

/// Removes T-junctions: splits boundary edges, with their triangles, at boundary vertices that lie exactly on them.
/// Nothing moves. Exact. Cost: n log n in the boundary edges.
void split_t_junctions(IndexedSoup& soup, RepairReport& report);

/// Merges boundary vertices that rounding has moved apart, up to the noise (vertex_merging.h), a distance in coordinate
/// units (rounding_noise.h). To be called first of the three, before T-junctions are split: otherwise a rounded corner
/// that lies on an edge would split off a piece as short as the noise, too short to be stitched. Cost: n log n in the
/// boundary edges.
void merge_rounded_corners(IndexedSoup& soup, double noise, RepairReport& report);

/// Stitches gaps: merges boundary vertices no farther apart than the tolerance (vertex_merging.h), then splits boundary
/// edges at boundary vertices within the tolerance, in coordinate units, where this stitches edges (split_selection.h).
/// No edge vanishes, but triangles thinner than the tolerance may become degenerate or turn over. Cost: n log n in the
/// boundary edges.
void stitch_gaps(IndexedSoup& soup, double tolerance, RepairReport& report);

}  // namespace algebra3d
