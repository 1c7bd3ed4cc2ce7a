#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/arrangement/vertex_pool.h"
#include "algebra3d/exact/predicates_filter.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d::arrangement {

/// A directed straight line between two vertices; what it bounds lies to its left in the projection.
using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;

/// Triangulates regions of one plane, given by all edges that bound them: any number of regions, with holes, touching
/// themselves and each other in vertices; an edge given in both directions lies within a region and becomes an edge of
/// the triangles. Edges do not cross. A vertex may lie inside an edge that is given in one direction: edges that end
/// there lie to the right of it and touch it from outside. Every triangle turns counter-clockwise in the
/// projection and has corners among the ends of edges alone, so that n corners and h holes in one region give
/// n + 2h - 2 triangles, which is the fewest. The triangles depend on the edges and points alone, not on the order of
/// the edges. False, and some triangles, if the edges bound no region: the left of one must be the left or the outside
/// of the next. Exact. Cost: n log n, no recursion.
/// Source: [hertel1983]: a sweep that triangulates behind itself.
[[nodiscard]] bool triangulate(const VertexPool& points, Projection projection, std::span<const DirectedEdge> edges,
                               std::vector<TriangleMesh::Triangle>& triangles);

}  // namespace algebra3d::arrangement
