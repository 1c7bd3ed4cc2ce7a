#pragma once

#include "algebra3d/base/box3.h"
#include "algebra3d/values/spatial_relations/detail/findings.h"
#include "algebra3d/values/spatial_relations/detail/mesh_set.h"

namespace algebra3d {

/// The relation of a box that is a segment, which has the role, with a surface or solid. Its contacts with the
/// triangles divide it; they and the middles between them are located. Cost: that of locating these.
void relate_segment(const Box3& segment, const MeshSet& mesh, Role role, Findings& findings, const Monitor& monitor);

}  // namespace algebra3d
