#pragma once

#include <span>

#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/planar/polygons.h"
#include "base/indices.h"

namespace algebra3d {

/// The polygons with the given boundary edges, in canonical form: the inverse of segments_of. The edges have the inside
/// to their left and come from `noded`. A face is connected by more than points; a cycle never touches itself, so a
/// hole that touches its outer cycle in a point is a separate cycle. Collinear corners are dropped. Outer cycles turn
/// counter-clockwise, holes clockwise; each begins at its lexicographically smallest corner, and faces and the holes of
/// a face are ordered by their first two corners. So equal point sets have equal polygons, which are valid
/// (polygon_validity.h). Exact. Errors: invalid_value, if the edges cross or bound no region; interrupted. Cost: as
/// `constrained_delaunay`.
Result<Polygons> boundary_polygons(const PointArray& points, std::span<const DirectedEdge> noded_edges,
                                   const Monitor& monitor = {});

/// The canonical form of polygons whose cycles have the inside to their left. Cycles may have collapsed or overlap in
/// part; segments that bound nothing are dropped.
Result<Polygons> boundary_polygons(const Polygons& oriented, const Monitor& monitor = {});

}  // namespace algebra3d
