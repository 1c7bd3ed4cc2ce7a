#pragma once

#include <span>

#include "algebra3d/kernel/repair/detail/convex_polygon.h"

namespace algebra3d {

/// True if a patch would enclose no more than noise after `covers` have closed its holes: all its corners lie between
/// two parallel planes that are `tolerance` apart, or each cover lies within that distance of the patch. Coordinates
/// are scaled. Decisions: rounded; false if the covers are so many that the answer would take too long. Cost: linear in
/// the patch, n log n if it is not flat.
bool is_thin(std::span<const Triangle3> patch, std::span<const Triangle3> covers, double tolerance);

}  // namespace algebra3d
