#pragma once

#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "algebra3d/kernel/repair/repair_report.h"

namespace algebra3d {

/// Drops duplicates: of triangles with the same three corners, in any order, one stays, namely the first with the more
/// frequent orientation. If both orientations are equally frequent, the surface around them decides (opposite_sets.h):
/// one stays, oriented like its neighbours, or none. No triangle may repeat a corner. Exact. Cost: linear; n log n in
/// the triangles at non-manifold edges.
void drop_duplicate_triangles(IndexedSoup& soup, RepairReport& report);

/// Drops all triangles of each set of duplicates in which both orientations are equally frequent; all others stay. For
/// meshes in which every edge is balanced: they stay so, and no winding number changes. Cost: as before.
void drop_opposite_triangles(IndexedSoup& soup, RepairReport& report);

/// True if two faces have the same three corners. Cost: as before.
bool has_duplicate_triangles(const TriangleMesh& mesh);

}  // namespace algebra3d
