#pragma once

#include <span>
#include <vector>

#include "algebra3d/base/monitor.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/planar/directed_edge.h"
#include "algebra3d/planar/polygons.h"

namespace algebra3d {

/// Triangulates what lies to the left of the edges: any number of regions with holes, touching themselves and each
/// other in points. Domain: edges that do not cross; points may be equal, and may lie inside edges, which are divided
/// there. An edge given once in each direction lies within a region and becomes an edge of the triangles. Corners are
/// ends of edges, of equal points the one of the lowest index. The triangles turn counter-clockwise, each begins with
/// its lowest index, and they are in ascending order. They form the constrained Delaunay triangulation: no corner that
/// a triangle sees, with edges opaque, lies inside its circle; of several corners on a circle the lexicographically
/// last ones are cut off first. So they depend on nothing but the points and the set of edges. Exact. Errors:
/// invalid_value, if edges cross, one is given twice, or they bound no region; interrupted. Cost: n log n unless edges
/// cross many triangles of the Delaunay triangulation of their ends. Source: [guibas1985], [dwyer1987], [anglada1997].
Result<std::vector<TriangleMesh::Triangle>> constrained_delaunay(const PointArray& points,
                                                                 std::span<const DirectedEdge> edges,
                                                                 const Monitor& monitor = {});

/// Triangulates polygons without a defect (polygon_validity.h); each is what lies between its cycles, whatever their
/// sense of rotation. Corners are indices into `valid.corners`. As above.
Result<std::vector<TriangleMesh::Triangle>> triangulate(const Polygons& valid, const Monitor& monitor = {});

}  // namespace algebra3d
