#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The convex hull of points as the mesh of a valid solid. Its vertices are the extreme points, in lexicographic order
/// and with the coordinates they were given; facets are divided from their lexicographically lowest corner. So it
/// depends on the set of points only, not on their order or number. Empty for the empty set; undefined, with the
/// reason, for other sets that lie in one plane. Exact, for all finite coordinates. Errors: interrupted. Cost: n log n
/// for most sets. Source: [barber1996].
Result<Maybe<TriangleMesh>> convex_hull(const PointArray& points, const Monitor& monitor = {});

/// The vertices of a mesh that have faces.
PointArray used_points(const TriangleMesh& mesh);

}  // namespace algebra3d
