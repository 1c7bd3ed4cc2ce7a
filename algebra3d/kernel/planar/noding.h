#pragma once

#include <span>
#include <vector>

#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/exact/point.h"
#include "base/indices.h"

namespace algebra3d {

/// Nodes directed edges that have the inside to their left: of equal points the lowest index is used, edges are divided
/// at every point of `points` inside them, edges of zero length are dropped, and opposite edges cancel each other.
/// Needed for regions at instants at which moving segments overlap. In ascending order; an edge that occurs n times
/// more in one direction than in the other is returned n times. Exact. Errors: invalid_value with the segments named,
/// if two edges that did not cancel cross in a point that is not in `points`; interrupted. Cost: n log n unless edges
/// cross many triangles of the Delaunay triangulation of the points.
Result<std::vector<DirectedEdge>> noded(const PointArray& points, std::span<const DirectedEdge> edges,
                                        const Monitor& monitor = {});

}  // namespace algebra3d
