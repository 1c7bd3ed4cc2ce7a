#pragma once

#include <span>

#include "algebra3d/kernel/arrangement/detail/radial_order.h"

namespace algebra3d::arrangement {

/// The half-plane at a space edge that comes just before the cell above the edge (faces_above.h), counter-clockwise.
/// `around`: at least one half-plane there, in the order of sort_around_space_edge. Exact.
SubEdgeSide half_plane_before_cell_above(const Subdivision& subdivision, std::span<const SubEdgeSide> around);

}  // namespace algebra3d::arrangement
