#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/kernel/planar/polygons.h"
#include "base/indices.h"

namespace algebra3d::planar {

/// Orientation of a cycle: 1 if counter-clockwise, -1 if clockwise, 0 if it folds back on itself at its
/// lexicographically smallest corner. Domain: at least one corner. Exact. Correct for simple cycles.
int rotation(const PointArray& corners, std::uint32_t begin, std::uint32_t end);

/// The segments of all cycles, in order. Segment i begins at corner i, or ends there if `is_reversed` is set for its
/// cycle.
std::vector<DirectedEdge> segments_of(const Polygons& polygons, const std::vector<bool>& is_reversed);

/// Per cycle: whether the inside of its face is to its right, as for a clockwise outer cycle or a counter-clockwise
/// hole.
std::vector<bool> reversed_cycles(const Polygons& polygons);

}  // namespace algebra3d::planar
