#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/detail/moved_points.h"

namespace algebra3d {

/// The result of snap rounding.
struct SnappedMesh {
  TriangleMesh mesh;
  double largest_detour = 0;  ///< largest distance of an edge from the straight line between its moved ends
};

/// Snap rounding: moves the vertices of a mesh to given points so that coplanar facets stay simple:
/// - edges are routed through points that they would pass over (facet_outlines.h);
/// - facets whose triangles would flip, in the projection along the axis nearest to their normal, or whose edges were
///   routed, are triangulated anew there;
/// - facets that collapsed to a line vanish.
/// Facets without moved points keep their triangles. Closed meshes stay closed. Crossings between facets are not
/// tested, so the result may have self-intersections. Exactness: all vertices are given points. Errors: interrupted.
/// Cost: n log n.
Result<SnappedMesh> snap_round(const TriangleMesh& mesh, const MovedVertices& moved, const Monitor& monitor = {});

/// Moves the corners of the triangles, and no more; triangles two of whose corners became one point are left out.
/// Errors: interrupted.
Result<SnappedMesh> moved_mesh(const TriangleMesh& mesh, PointArray points, const Monitor& monitor = {});

}  // namespace algebra3d
