#pragma once

#include <atomic>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/halfedge/box_hierarchy.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The faces of each component of a valid volume, ascending; components ordered by their lowest faces. Shells are faces
/// connected across common edges; a shell that bounds a cavity belongs to the body right around it, a body within a
/// cavity is a component of its own. `hierarchy` is over all faces. Exact. Errors: interrupted.
/// Cost: linear; for each cavity one search in the hierarchy for the face above its top. Cavities whose tops touch
/// other shells cost more: one vertical line for each, and for each body around it.
Result<std::vector<std::vector<FaceId>>> solid_components(const TriangleMesh& mesh, const BoxHierarchy& hierarchy,
                                                          const std::atomic<bool>* cancel = nullptr);

}  // namespace algebra3d
