#pragma once

#include <span>
#include <vector>

#include "algebra3d/base/monitor.h"
#include "algebra3d/exact/point.h"
#include "algebra3d/planar/directed_edge.h"

namespace algebra3d {

/// Brings directed edges, which have the inside to their left, to the form of a subdivision: of equal points the lowest
/// index is used, edges are divided at every point of `points` that lies inside them, edges of zero length are dropped,
/// and of opposite ones along the same line as many as there are of the other direction. For regions at instants at
/// which moving segments lie on each other. In ascending order; an edge that occurs n times more in one direction than
/// in the other is given n times. Exact. Errors: invalid_value with the segments named, if two edges cross in a point
/// that is none of `points`, unless a pair of opposite edges between the same points has cancelled them; interrupted.
/// Cost: n log n unless edges cross many triangles of the Delaunay triangulation of the points.
Result<std::vector<DirectedEdge>> noded(const PointArray& points, std::span<const DirectedEdge> edges,
                                        const Monitor& monitor = {});

}  // namespace algebra3d
