#pragma once

#include "algebra3d/arrangement/pieces.h"
#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"

namespace algebra3d::arrangement {

/// Adds the covers that only surfaces with boundary need: along a boundary edge no further face of the operand says
/// which facets of the same plane hold it, so facets of other operands are asked for the middle of each such piece.
/// Exact. Errors: interrupted. Cost: that of looking up each piece of a boundary edge in a tree over the faces of the
/// plane.
Status complete_covers(const Skeleton& skeleton, Pieces& pieces, const Monitor& monitor);

}  // namespace algebra3d::arrangement
