#pragma once

#include <atomic>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/search/box_hierarchy.h"

namespace algebra3d {

/// The faces of each component of a valid volume, ascending; components ordered by their lowest faces. Shells are faces
/// connected across common edges. The shell of a cavity belongs to the body directly around it; a body in a cavity is a
/// separate component. `hierarchy` is over all faces. Exact. Errors: interrupted. Cost: linear; for each cavity one
/// search in the hierarchy for the face above its top. A cavity whose top touches another shell costs one vertical
/// line, and one per body around it.
Result<std::vector<std::vector<FaceId>>> solid_components(const TriangleMesh& mesh, const BoxHierarchy& hierarchy,
                                                          const std::atomic<bool>* cancel = nullptr);

}  // namespace algebra3d
