#pragma once

#include "algebra3d/base/monitor.h"
#include "algebra3d/repair/facet_list.h"
#include "algebra3d/repair/repair_report.h"

namespace algebra3d {

/// Divides boundary edges at the boundary vertices that lie on them, and the facets with them; nothing moves. An edge
/// is a boundary edge here if one facet has it. Exact. Cost: n log n in the boundary edges.
void divide_edges(FacetList& facets, RepairReport& report);

/// Joins boundary vertices no farther apart than the noise, as `close_cracks` does. To be done before edges are
/// divided: a corner of a neighbour that rounding moved may lie on an edge, which would be left with a piece as short
/// as the noise. Cost: n log n in the boundary edges.
void join_equal_corners(FacetList& facets, double noise, RepairReport& report);

/// Joins boundary vertices no farther apart than the tolerance, nearest first, and divides boundary edges at the
/// boundary vertices that are no farther from them than that. The vertex with the lower number stays where it is. Never
/// joins the corners of one facet, nor two vertices that are farther apart than a third of a boundary edge at one of
/// them; so no facet vanishes. Facets may become degenerate or turn over where they are thinner than the tolerance.
/// Cost: n log n in the boundary edges.
void close_cracks(FacetList& facets, double tolerance, RepairReport& report);

}  // namespace algebra3d
