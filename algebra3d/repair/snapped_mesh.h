#pragma once

#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/repair/facet_outlines.h"

namespace algebra3d {

struct SnappedMesh {
  TriangleMesh mesh;
  double largest_detour = 0;  ///< no edge leads farther than this from the straight line between its moved ends
};

/// The mesh with its vertices moved a little, in such a way that facets stay as simple as they were:
/// - edges are led through vertices as FacetOutlines does it;
/// - facets are triangulated anew as they look now along the axis that is nearest to their normal, so that no triangle
///   turns over;
/// - facets that became as thin as a line vanish.
/// Facets of which nothing moved keep their triangles. Closed meshes stay closed. What is not looked at are facets
/// that pass through each other away from common edges: the result may have self-intersections.
/// Exactness: the result is made of the new points alone. Errors: none. Cost: n log n.
SnappedMesh snapped_mesh(const TriangleMesh& mesh, const MovedVertices& moved);

/// The triangles with their corners moved, and no more; without those that lost a corner.
SnappedMesh moved_mesh(const TriangleMesh& mesh, PointArray points);

}  // namespace algebra3d
