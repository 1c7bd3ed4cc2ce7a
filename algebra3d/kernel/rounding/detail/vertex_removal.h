#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/rounding/detail/triangle_stars.h"

namespace algebra3d {

/// Whether triangles may be thinner than two tolerances.
enum class ThinTriangles : std::uint8_t { refused, allowed };

/// Removes vertices that lie on the surface, or on an edge of it, anyway: a vertex is merged with a neighbour if it is
/// within `tolerance`, in coordinate units, of all triangles that replace those around it, if none of these is thinner
/// than two tolerances or turned over, and if the surface stays a manifold there. `may_go`: per vertex; non-manifold
/// vertices stay. The surface moves by two tolerances at most; triangles may come to cross others nearby. Where thin
/// triangles are allowed (ThinFan), also vertices of needles and folds go, and how far the surface moves in all is not
/// bounded. Returns whether any vertex has gone. Domain: coordinates of the vertices that may go, and of those around
/// them, are doubles. Not exact; deterministic. Errors: interrupted. Cost: linear, and about a microsecond per vertex
/// that may go. Source: vertex decimation [schroeder1992], here by edge collapses.
Result<bool> remove_superfluous_vertices(TriangleStars& stars, const std::vector<bool>& may_go, double tolerance,
                                         const Monitor& monitor = {}, ThinTriangles thin = ThinTriangles::refused);

}  // namespace algebra3d
