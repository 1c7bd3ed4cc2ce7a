#pragma once

#include <span>

#include "algebra3d/base/monitor.h"
#include "algebra3d/planar/directed_edge.h"
#include "algebra3d/planar/polygons.h"

namespace algebra3d {

/// The polygons whose boundary the edges are, in canonical form: the inverse of taking segments. The edges have the
/// inside to their left, and are as `noded` gives them. A face is what hangs together by more than points; a cycle
/// touches itself nowhere, so that a hole that touches its outer cycle in a point is a cycle of its own. Corners at
/// which a cycle goes straight on are dropped. Outer cycles turn counter-clockwise, holes clockwise; each begins at its
/// lexicographically smallest corner, and faces and the holes of a face are ordered by their first two corners. So
/// equal point sets give equal polygons, and these have no defect (polygon_validity.h). Exact.
/// Errors: invalid_value, if the edges cross or bound no region; interrupted. Cost: as `constrained_delaunay`.
Result<Polygons> boundary_polygons(const PointArray& points, std::span<const DirectedEdge> noded_edges,
                                   const Monitor& monitor = {});

/// The same of polygons whose cycles have the inside to their left, and may have collapsed or lie on each other in
/// part: what bounds nothing is left out. Of valid polygons that are `oriented` it is their canonical form.
Result<Polygons> boundary_polygons(const Polygons& oriented, const Monitor& monitor = {});

}  // namespace algebra3d
