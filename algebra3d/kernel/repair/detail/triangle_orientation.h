#pragma once

#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "algebra3d/kernel/repair/repair_report.h"

namespace algebra3d {

/// Flips triangles until neighbours agree, in three steps:
///  1. within each manifold patch (manifold_patches.h; directions do not count there), so that both triangles of an
///     edge run along it in opposite directions, as far as possible (not on a Moebius strip): the orientation with more
///     area stays;
///  2. patches that touch each other along non-manifold edges, so that inside and outside alternate around the edge
///     (patch_links.h): in each cluster of patches, too, the orientation with more area stays;
///  3. single patches, as long as that reduces the imbalance of the non-manifold edges (patch_balance.h).
/// Decisions: by rounded areas and lengths. Cost: linear, and a few passes over the non-manifold edges.
void orient_triangles(IndexedSoup& soup, RepairReport& report);

}  // namespace algebra3d
