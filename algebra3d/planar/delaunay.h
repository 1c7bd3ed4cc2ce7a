#pragma once

#include "algebra3d/base/monitor.h"
#include "algebra3d/planar/plane_points.h"
#include "algebra3d/planar/subdivision.h"

namespace algebra3d::planar {

/// The Delaunay triangulation of all vertices: the only one, by the rule of PlanePoints for points on a circle.
/// Vertices on one line become a path. Its unbounded face has an outer half-edge, if there are two vertices. Exact.
/// Errors: interrupted. Cost: n log n, mostly linear after sorting. Source: [guibas1985] for the merging, [dwyer1987]
/// for doing it first within strips and then across.
Result<Subdivision> delaunay(const PlanePoints& points, const Monitor& monitor);

}  // namespace algebra3d::planar
