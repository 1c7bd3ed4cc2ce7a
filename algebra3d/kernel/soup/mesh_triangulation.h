#pragma once

#include <array>
#include <vector>

#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"

namespace algebra3d {

/// A triangle of a face, by the half-edges that leave its corners.
using CornerTriangle = std::array<HalfedgeId, 3>;

/// Triangulates the faces of a mesh, face by face in order, with the orientation of the faces. Corners that repeat the
/// vertex before them do not count; a face with fewer than three others has no triangles, but a face of three corners
/// is its triangle in any case.
/// - A face that is strictly convex in the projection along the axis nearest to its normal becomes a fan around its
///   first corner.
/// - Any other face that is simple in that projection, or in that along another axis, is triangulated there without
///   overlap. So a flat polygon without crossings is triangulated in its plane.
/// - A face that touches or crosses itself in all three becomes the triangles of least total area.
/// Exactness: decisions in projections are exact, the normal and areas are rounded. Errors: interrupted. Cost: n log n
/// for a face of n corners; n^3 for those that cross themselves (loop_triangulation.h).
Result<std::vector<CornerTriangle>> triangulate_faces(const PolygonMesh& mesh, const Monitor& monitor = {});

}  // namespace algebra3d
