#pragma once

#include "algebra3d/base/monitor.h"
#include "algebra3d/values/spatial_relations/detail/findings.h"
#include "algebra3d/values/spatial_relations/detail/mesh_set.h"

namespace algebra3d {

/// Finds out how two surfaces or solids, which are not empty, lie relative to each other, until the question is
/// answered.
///
/// Where triangles have a segment in common, the half-planes of each set at the segment are compared with the faces of
/// the other in radial order; that shows whether the set goes on outside of, inside of or on the other there. A part of
/// a set that the other one bounds has such a segment in its boundary. A component without any lies wholly inside or
/// outside, but for single points: one point of it is located. So nothing is computed but signs
/// (docs/spatial-relations.md).
void relate_meshes(const MeshSet& first, const MeshSet& second, Findings& findings, const Monitor& monitor);

}  // namespace algebra3d
