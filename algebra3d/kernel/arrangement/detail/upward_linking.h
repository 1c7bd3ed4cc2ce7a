#pragma once

#include <map>

#include "algebra3d/kernel/arrangement/detail/linking.h"
#include "algebra3d/kernel/arrangement/detail/point_location.h"

namespace algebra3d::arrangement {

/// Per set, by its representative (WindingSets::Position): the windings of the representative, as far as they are
/// known.
using SetWindings = std::map<FrontWindingId, WindingVector>;

/// Links sets with patches that more than eight operands may surround to the next patch or the cell above them: an
/// upward ray from the highest face of each set hits a patch of another set, to which this one is linked, or leads to
/// the unbounded cell, whose windings are 0. So each set looks at one other, and none needs more than the way to it,
/// however many are around it. Sets whose rays hit faces that are in no patch are left to be seeded. For operands of
/// which each is closed alone. Gives the windings of those sets of which a ray leads to the unbounded cell, directly or
/// by way of the sets that are linked now. Exact. Errors: interrupted.
Result<SetWindings> link_upwards(const Subdivision& subdivision, LinkedWindings& linked, PointLocation& location,
                                 const Monitor& monitor);

}  // namespace algebra3d::arrangement
