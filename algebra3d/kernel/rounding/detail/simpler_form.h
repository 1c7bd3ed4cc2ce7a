#pragma once

#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/coordinate_grid.h"
#include "algebra3d/kernel/rounding/detail/triangle_stars.h"

namespace algebra3d {

/// How far off the surface, in coordinate units, vertices of a rounded solid are superfluous; 0 on a grid that is
/// coarse for the solid, on which all stay. `spacing`: that of the numbers of the grid at the solid's largest
/// coordinate.
double superfluous_within(const TriangleMesh& solid, const CoordinateGrid& grid, double spacing);

/// Removes vertices that lie on the surface or on an edge of it anyway, up to a tolerance, and needles of that kind:
/// rounding left them there, now or earlier. `may_change`: per vertex. The surface moves by two tolerances at most.
/// Returns whether anything has changed. Errors: interrupted. Cost: that of remove_superfluous_vertices and
/// flip_needles.
Result<bool> make_simpler(TriangleStars& stars, const std::vector<bool>& may_change, double tolerance,
                          const Monitor& monitor);

}  // namespace algebra3d
