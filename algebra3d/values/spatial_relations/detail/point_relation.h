#pragma once

#include "algebra3d/base/box3.h"
#include "algebra3d/values/spatial_relations/detail/findings.h"
#include "algebra3d/values/spatial_relations/detail/mesh_set.h"

namespace algebra3d {

// Relations of points with other sets. `role` is that of the points; nothing is empty.

/// Cost: linear in both.
void relate_points(const PointSet& points, const PointSet& others, Findings& findings);
/// The box is not a point. Cost: linear.
void relate_points(const PointSet& points, const Box3& box, Role role, Findings& findings);
/// Cost: that of locating each point.
void relate_points(const PointSet& points, const MeshSet& mesh, Role role, Findings& findings, const Monitor& monitor);

}  // namespace algebra3d
