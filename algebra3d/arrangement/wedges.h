#pragma once

#include "algebra3d/arrangement/pieces.h"
#include "algebra3d/arrangement/winding_sets.h"

namespace algebra3d::arrangement {

/// Unites the sides of pieces that bound one cell, as far as they follow each other round a vertex: neighbours in the
/// angular order of the pieces of a plane at a vertex share the cell between them. A hole's side is not united with
/// that of the outer boundary. Sides that no facet covers are left alone: they bound no cell. The member of a piece's
/// left side is twice its number, that of its right side one more. Exact. Cost: n log n.
void join_cells(const Skeleton& skeleton, const Pieces& pieces, WindingSets& sides);

}  // namespace algebra3d::arrangement
