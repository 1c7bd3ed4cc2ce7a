#pragma once

#include "algebra3d/values/spatial_relations/detail/mesh_set.h"

namespace algebra3d {

/// Where the half-plane of `point` at the edge of a half-edge lies relative to the set, near an inner point of the
/// edge: on one of its faces (`boundary`), off the set (`outside`), or within the solid (`inside`). The point must be
/// off the line of the edge. Exact: a comparison in radial order.
Placement place_half_plane(const MeshSet& set, HalfedgeId halfedge, PointRef point);

}  // namespace algebra3d
