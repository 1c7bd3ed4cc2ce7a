#pragma once

#include <vector>

#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// New places of the vertices of a mesh, and how far each is, at most, from the old one.
struct MovedVertices {
  PointArray points;
  std::vector<double> movements;
};

struct SnappedMesh {
  TriangleMesh mesh;
  double largest_detour = 0;  ///< no edge leads farther than this from the straight line between its moved ends
};

/// The mesh with its vertices moved a little, in such a way that facets stay as simple as they were:
/// - a vertex that an edge may have passed over on its way becomes a corner of that edge, in all facets along it;
/// - facets are triangulated anew as they look now along the axis that is nearest to their normal, so that no triangle
///   turns over;
/// - facets that became as thin as a line vanish.
/// Facets of which nothing moved keep their triangles. Closed meshes stay closed. What is not looked at are facets
/// that pass through each other away from common edges: the result may have self-intersections.
/// Exactness: the result is made of the new points alone. Errors: none. Cost: n log n.
/// Source: the hot pixels of [hobby1999], here about segments in space.
SnappedMesh snapped_mesh(const TriangleMesh& mesh, const MovedVertices& moved);

/// The triangles with their corners moved, and no more; without those that lost a corner, and pairs that lie upon each
/// other with opposite fronts.
SnappedMesh moved_mesh(const TriangleMesh& mesh, PointArray points);

}  // namespace algebra3d
