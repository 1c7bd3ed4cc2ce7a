#pragma once

#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/repair/detail/convex_polygon.h"
#include "base/id_vector.h"

namespace algebra3d {

/// Per face: whether it is of a loose sheet, which no comparison of enclosed space has to count: a connected component
/// whose faces all have the corners of one of `sheets`, with all others farther away than a hundredth of the diagonal
/// of its box. The walls of a room that do not quite meet are sheets, but not loose. Decisions: rounded, by corners.
/// Cost: n log n.
IdVector<FaceId, bool> loose_sheets(const TriangleMesh& mesh, const std::vector<Triangle3>& sheets);

}  // namespace algebra3d
