#pragma once

#include "algebra3d/arrangement/pieces.h"

namespace algebra3d::arrangement {

/// Adds the covers that only surfaces with boundary need: along a boundary edge no further face of the operand says
/// which facets of the same plane hold it, so facets of other operands are asked for the middle of each such piece.
/// Exact. Cost: that of looking up each piece of a boundary edge in a tree over the faces of the plane.
void complete_covers(const Skeleton& skeleton, Pieces& pieces);

}  // namespace algebra3d::arrangement
