#pragma once

#include <atomic>
#include <cstddef>
#include <optional>

#include "algebra3d/base/error.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/rounding/coordinate_grid.h"
#include "algebra3d/rounding/rounding_method.h"

namespace algebra3d {

/// A surface rounded to a grid, or the reason why there is none.
struct RoundedSurface {
  /// A valid surface with all coordinates on the grid.
  std::optional<TriangleMesh> mesh;
  const char* reason = "";         ///< why there is none
  std::size_t moved_vertices = 0;  ///< of the given ones
  double largest_movement = 0;     ///< in coordinate units: no point of the result is farther from the given surface
  RoundingMethod method = RoundingMethod::none;  ///< that found the mesh
  /// How many vertices lie inside edges or faces of others: valid, but other programs may take them for crossings.
  std::size_t contact_vertices = 0;
  /// In coordinate units: where triangles crossed after the vertices had moved, features nearer to each other than this
  /// were joined. 0 if none were.
  double reach = 0;
};

/// Rounds the vertices of a valid surface to a grid, and proves the result. The surface is snap rounded
/// (snap_rounding.h); where triangles cross then, features that are nearly one are joined (feature_snapping.h), and
/// what still crosses is divided and rounded again, in turns. If triangles still cross after some turns, faces of cubes
/// replace the surface (square_cover.h), which cannot fail. Triangles that come to lie upon each other become one,
/// oriented as the first of them; those that become thinner than the grid vanish. There is no result only if a
/// coordinate is out of range. `cancel` ends the call with the error interrupted.
/// Exactness: rounded; validity is exact. Deterministic. Errors: interrupted, limit_exceeded. Cost: that of snap
/// rounding and a proof, for nearly all surfaces.
Result<RoundedSurface> rounded_surface(const TriangleMesh& surface, const CoordinateGrid& grid,
                                       const std::atomic<bool>* cancel = nullptr);

}  // namespace algebra3d
