#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "base/indices.h"

namespace algebra3d {

/// Triangulates regions of one plane, given by their boundary edges: any number of regions with holes, which may touch
/// themselves and each other in vertices. An edge given in both directions lies within a region and becomes an edge of
/// the triangles. Edges must not cross. A vertex may lie inside an edge that is given in one direction; edges that end
/// there lie to the right of it and touch it from outside. Every triangle turns counter-clockwise in the projection and
/// has corners at ends of edges only, so that a region with n corners and h holes has n + 2h - 2 triangles, the
/// minimum. The triangles do not depend on the order of the edges. False, with incomplete triangles, if the edges bound
/// no region. Exact. Cost: n log n, no recursion. Source: [hertel1983]: a sweep line that triangulates behind itself.
///
/// There are three triangulations. This one is for facets of an arrangement, which lie in any plane and have few, exact
/// corners; the number of triangles matters, not their shape. constrained_delaunay.h is for regions of the plane z = 0,
/// whose triangles are shown and stored: they have the best shape and depend on the region only, at the cost of
/// in-circle tests. loop_triangulation.h (soup) covers loops that are not planar.
[[nodiscard]] bool triangulate_by_sweep(const PointTable& points, Projection projection,
                                        std::span<const DirectedEdge> edges, std::vector<IndexTriangle>& triangles);

}  // namespace algebra3d
