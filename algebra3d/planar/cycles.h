#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/planar/directed_edge.h"
#include "algebra3d/planar/polygons.h"

namespace algebra3d::planar {

/// Sense of rotation of the cycle of these corners: 1 if counter-clockwise, -1 if clockwise, 0 if it has no area at its
/// lexicographically smallest corner, as a cycle that folds back on itself there. Domain: a corner at least. Exact.
/// Right for each simple cycle.
int rotation(const PointArray& corners, std::uint32_t begin, std::uint32_t end);

/// The segments of all cycles, in order, each beginning at the corner of its own number unless `is_reversed` says of
/// its cycle that it runs the other way, into that corner.
std::vector<DirectedEdge> segments_of(const Polygons& polygons, const std::vector<bool>& is_reversed);

/// Of each cycle: whether it has the inside of its face to its right, as a clockwise outer one or a counter-clockwise
/// hole.
std::vector<bool> reversed_cycles(const Polygons& polygons);

}  // namespace algebra3d::planar
