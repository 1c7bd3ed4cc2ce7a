#pragma once

#include <vector>

#include "algebra3d/kernel/rounding/detail/triangle_stars.h"

namespace algebra3d {

/// Flips the longest edges of needles: triangles that are not higher than `tolerance`, in coordinate units, whose
/// corners are all in `may_change` (per vertex). Rounding often turns needles over, and then they cross what lies
/// behind their longest edge; afterwards that edge goes through the third corner. Only where both new triangles are
/// higher than the tolerance and look where the neighbour of the needle looked, and where the surface stays a manifold.
/// It moves by the tolerance at most. Returns whether anything has changed. Not exact; deterministic. Cost: linear, and
/// less than a microsecond per needle.
bool flip_needles(TriangleStars& stars, const std::vector<bool>& may_change, double tolerance);

}  // namespace algebra3d
