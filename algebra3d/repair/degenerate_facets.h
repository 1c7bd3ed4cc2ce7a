#pragma once

#include "algebra3d/repair/facet_list.h"
#include "algebra3d/repair/repair_report.h"

namespace algebra3d {

/// Drops facets that repeat a corner or whose corners lie on one line. What such a facet held together, an edge on one
/// side and its two halves on the other, `divide_edges` (cracks.h) mends. Exact. Cost: linear.
void drop_degenerate_facets(FacetList& facets, RepairReport& report);

/// Of facets with the same three corners, whatever their order, the first is kept that looks the way most do. If as
/// many look one way as the other, they have nothing between them, and none is kept, unless all that hangs together
/// with them across edges is double in this way: then one is. Facets repeat no corner. Exact. Cost: linear, n log n in
/// the facets at edges that are not manifold.
void drop_duplicate_facets(FacetList& facets, RepairReport& report);

/// Of facets with the same three corners all are dropped if as many look one way as the other; the others stay. No
/// winding number changes. Cost: as before.
void drop_opposed_facets(FacetList& facets, RepairReport& report);

/// True if two faces have the same three corners. Cost: as before.
bool has_duplicate_facets(const TriangleMesh& mesh);

}  // namespace algebra3d
