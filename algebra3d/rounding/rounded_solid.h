#pragma once

#include <atomic>
#include <cstddef>
#include <optional>

#include "algebra3d/base/error.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/rounding/coordinate_grid.h"

namespace algebra3d {

/// A solid rounded to a grid, or the reason why there is none.
struct RoundedSolid {
  /// A valid volume with all coordinates on the grid. Nothing if none was found, which happens where much of the solid
  /// is thinner than the grid.
  std::optional<TriangleMesh> mesh;
  const char* reason = "";          ///< why there is none
  std::size_t moved_vertices = 0;   ///< of the given ones
  double largest_movement = 0;      ///< in coordinate units: no point of the new boundary is farther from the given one
  std::size_t attempts_failed = 0;  ///< how many roundings were tried whose triangles crossed
  /// The numbers of shells, given and rounded: fewer if some vanished, or have come to touch in an edge. Both 0 if
  /// nothing moved.
  std::size_t shells_before = 0, shells_after = 0;
};

/// Rounds the vertices of a solid to a grid, and proves the result (docs/set-operations.md, "Rounding of
/// solids"). Parts thinner than the grid vanish. The solid is snap rounded first (snap_rounding.h). If triangles
/// cross each other then, two ways are tried:
///  1. vertices are moved and no more, and the mesh is divided at itself; the cells with a positive winding number are
///     kept, and the new corners rounded again, a few times;
///  2. crowded vertices are snapped to a grid twice as coarse, and so on, and facets that nearly lie upon each other
///     are made coplanar (coplanar_snapping.h), in turns with dividing the mesh at itself.
/// `cancel` ends the call with the error interrupted; progress is not told. Exactness: rounded; validity is exact.
/// Errors: interrupted, limit_exceeded.
/// Cost: that of a proof, for nearly all solids. Source: after [hobby1999] and [halperin2002].
Result<RoundedSolid> rounded_solid(const TriangleMesh& solid, const CoordinateGrid& grid,
                                   const std::atomic<bool>* cancel = nullptr);

}  // namespace algebra3d
