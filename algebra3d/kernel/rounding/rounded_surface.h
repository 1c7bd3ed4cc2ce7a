#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/rounding/coordinate_grid.h"
#include "algebra3d/kernel/rounding/rounded_mesh.h"

namespace algebra3d {

/// A surface rounded to a grid, or the reason why there is none.
using RoundedSurface = RoundedMesh;

/// Rounds the vertices of a valid surface to a grid, and proves the result. The ladder is that of solids
/// (rounded_solid.h); where a mesh is divided all pieces stay, no vertices are removed, and at last faces of cubes
/// replace the surface (square_cover.h), which cannot fail. Triangles that come to lie upon each other become one,
/// oriented as the first of them; those that become thinner than the grid vanish. There is no result only if a
/// coordinate is out of range. The monitor may end the call with the error interrupted, and receives the methods that
/// are tried. Exactness: rounded; validity is exact. Deterministic. Errors: interrupted, limit_exceeded. Cost: that of
/// snap rounding and a proof, for nearly all surfaces.
Result<RoundedSurface> rounded_surface(const TriangleMesh& surface, const CoordinateGrid& grid,
                                       const Monitor& monitor = {});

}  // namespace algebra3d
