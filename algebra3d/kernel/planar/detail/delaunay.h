#pragma once

#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/planar/detail/plane_points.h"
#include "algebra3d/kernel/planar/detail/subdivision.h"

namespace algebra3d::planar {

/// The Delaunay triangulation of all vertices, unique by the rule of PlanePoints for points on a circle. Collinear
/// vertices become a path. With two vertices or more, outer_halfedge() is set. Exact. Errors: interrupted. Cost: n log
/// n, mostly linear after sorting. Source: [guibas1985] for the merging, [dwyer1987] for merging first within strips
/// and then across.
Result<Subdivision> delaunay(const PlanePoints& points, const Monitor& monitor);

}  // namespace algebra3d::planar
