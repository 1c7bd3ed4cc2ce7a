#pragma once

#include <cstddef>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {

// The bodies of a solid: the connected parts of its interior. Parts that touch in an edge only are different bodies,
// though their faces are connected across that edge.

/// Number of bodies of a valid volume. Exact. Errors: interrupted. Cost: linear.
Result<std::size_t> body_count(const TriangleMesh& mesh, const Monitor& monitor);

/// Each body as a solid, with its cavities. Exact. Errors: interrupted. Cost: linear; for each cavity a ray for each
/// body.
Result<std::vector<Volume3d>> bodies_of(const Volume3d& solid, const Monitor& monitor);

}  // namespace algebra3d
