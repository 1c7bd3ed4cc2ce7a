#pragma once

#include "algebra3d/kernel/repair/detail/oriented_patches.h"

namespace algebra3d {

/// Flips single manifold patches as long as that reduces the imbalance of the edges with more than two triangles: the
/// sum over these edges of the length times the difference between the numbers of triangles in the two directions. A
/// few passes over all patches. Decisions: by rounded lengths.
void balance_patches(OrientedPatches& patches);

}  // namespace algebra3d
