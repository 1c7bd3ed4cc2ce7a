#pragma once

#include <atomic>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "algebra3d/values/types/spatial.h"
#include "base/context.h"

namespace algebra3d {

/// The faces of each component of a valid volume, ascending; components ordered by their lowest faces. Shells are faces
/// connected across common edges. The shell of a cavity belongs to the body directly around it; a body in a cavity is a
/// separate component. `hierarchy` is over all faces. Exact. Errors: interrupted. Cost: linear; for each cavity one
/// search in the hierarchy for the face above its top. A cavity whose top touches another shell costs one vertical
/// line, and one per body around it.
Result<std::vector<std::vector<FaceId>>> solid_components(const TriangleMesh& mesh, const BoxHierarchy& hierarchy,
                                                          const std::atomic<bool>* cancel = nullptr);

/// The parts of a surface or solid that are connected across common edges, in the order of their first triangles; a
/// solid has those of `solid_components`. Empty geometry has none. Exact. Errors and cost: as above.
Result<std::vector<Surface3d>> components_of(Context& context, const Surface3d& surface);
Result<std::vector<Volume3d>> components_of(Context& context, const Volume3d& solid);

}  // namespace algebra3d
