#pragma once

#include "algebra3d/repair/facet_list.h"
#include "algebra3d/repair/repair_report.h"

namespace algebra3d {

/// Drops misfits, facets that were written with a wrong corner: a hole of the size of one facet lies beside such a
/// facet, with which it would have one edge in common and the three corners of the hole, but for one. Two edges of the
/// facet lack a neighbour, or one does and the other has one too many. It is dropped if its wrong corner lies behind
/// the facet that closes the hole, so that a dent would stay, or if adding facets on both sides of it takes more area.
/// Requires oriented facets. Decisions: rounded. Cost: linear, n log n in the open edges.
void drop_misfits(FacetList& facets, RepairReport& report);

}  // namespace algebra3d
