#pragma once

#include <span>
#include <vector>

#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/planar/polygons.h"
#include "base/indices.h"

namespace algebra3d {

/// The constrained Delaunay triangulation of the regions to the left of the edges: any number of regions with holes,
/// which may touch themselves and each other in points. Domain: edges that do not cross; points may be equal, and may
/// lie inside edges, which are divided there. An edge given in both directions lies within a region and becomes an edge
/// of the triangles. Corners are ends of edges; of equal points the one with the lowest index is used. The triangles
/// turn counter-clockwise, each begins with its lowest index, and they are in ascending order. No corner visible from a
/// triangle, with edges opaque, lies inside its circle; of several corners on a circle the lexicographically last ones
/// are cut off first. So the result depends only on the points and the set of edges. Exact. Errors: invalid_value, if
/// edges cross, one is given twice, or they bound no region; interrupted. Cost: n log n unless edges cross many
/// triangles of the Delaunay triangulation of their ends. Source: [guibas1985], [dwyer1987], [anglada1997].
Result<std::vector<IndexTriangle>> constrained_delaunay(const PointArray& points, std::span<const DirectedEdge> edges,
                                                        const Monitor& monitor = {});

/// Triangulates valid polygons (polygon_validity.h), whatever the orientation of their cycles. Corners are indices into
/// `valid.corners`. Otherwise as above.
Result<std::vector<IndexTriangle>> triangulate(const Polygons& valid, const Monitor& monitor = {});

}  // namespace algebra3d
