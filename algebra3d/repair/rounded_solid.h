#pragma once

#include <atomic>
#include <cstddef>
#include <optional>

#include "algebra3d/base/error.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/repair/coordinate_grid.h"

namespace algebra3d {

struct RoundedSolid {
  /// A valid volume with all coordinates on the grid; nothing if none was found, as it may happen where much is
  /// thinner than the grid.
  std::optional<TriangleMesh> mesh;
  const char* reason = "";          ///< why there is none
  std::size_t moved_vertices = 0;   ///< of the given ones
  double largest_movement = 0;      ///< no point of the new boundary is farther from the given one
  std::size_t attempts_failed = 0;  ///< roundings in which triangles passed through each other
  /// Connected components of the boundary, given and rounded: fewer if some vanished, or have come to touch. Both 0 if
  /// nothing moved.
  std::size_t shells_before = 0, shells_after = 0;
};

/// The solid with its vertices moved to a grid, proved anew. What is thinner than the grid vanishes.
/// Vertices are rounded and facets triangulated anew (snapped_mesh.h). If triangles of the result pass through each
/// other, the triangles are divided at one another, the places with a positive winding number kept, and the new corners
/// rounded, a few times. If that does not help, crowded vertices are snapped to a grid twice as coarse, and so on, and
/// facets that nearly lie upon each other are made to do so exactly (pressed_sheets.h).
/// Exactness: rounded; validity is exact. Errors: interrupted, limit_exceeded.
/// Cost: that of a proof, for nearly all solids. Source: after [hobby1999] and [halperin2002].
Result<RoundedSolid> rounded_solid(const TriangleMesh& solid, const CoordinateGrid& grid,
                                   const std::atomic<bool>* cancel = nullptr);

}  // namespace algebra3d
