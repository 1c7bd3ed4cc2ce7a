#pragma once

#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {

// The bodies of a solid: the connected parts of its interior. Parts that touch in an edge only are different bodies,
// though their faces are connected across that edge.

/// Each body as a solid, with its cavities. Exact. Errors: interrupted. Cost: linear; for each cavity a ray for each
/// body whose box holds it.
Result<std::vector<Volume3d>> bodies_of(const Volume3d& solid, const Monitor& monitor);

/// True if a part of a solid, a valid volume, has two bodies in one body of the solid. Exact. Errors: interrupted.
/// Cost: linear; for each body of the part a ray for each body of the solid whose box holds it.
Result<bool> has_divided_body(const Volume3d& solid, const TriangleMesh& part, const Monitor& monitor);

}  // namespace algebra3d
