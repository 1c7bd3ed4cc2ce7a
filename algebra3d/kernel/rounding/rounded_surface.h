#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/coordinate_grid.h"
#include "algebra3d/kernel/rounding/rounding_method.h"

namespace algebra3d {

/// A surface rounded to a grid, or the reason why there is none.
struct RoundedSurface {
  /// A valid surface with all coordinates on the grid.
  std::optional<TriangleMesh> mesh;
  std::string reason = {};         ///< why there is none
  std::size_t moved_vertices = 0;  ///< of the given ones
  /// In coordinate units: no point of the result is farther from the given surface. Parts that vanished are not
  /// counted.
  double largest_movement = 0;
  RoundingMethod method = RoundingMethod::none;  ///< that found the mesh
  /// How many vertices lie inside edges or faces of others: valid, but other programs may take them for crossings.
  std::size_t contact_vertices = 0;
  /// In coordinate units: where triangles crossed after the vertices had moved, features nearer to each other than this
  /// were joined. 0 if none were.
  double reach = 0;
};

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
