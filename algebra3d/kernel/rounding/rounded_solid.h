#pragma once

#include <cstddef>
#include <string>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/rounding/coordinate_grid.h"
#include "algebra3d/kernel/rounding/rounded_mesh.h"

namespace algebra3d {

/// A solid rounded to a grid, or the reason why there is none.
struct RoundedSolid : RoundedMesh {
  /// The numbers of shells, given and rounded: fewer if some vanished, or have come to touch in an edge. Both 0 if
  /// there are as many as before.
  std::size_t shells_before = 0, shells_after = 0;
};

/// The part of a note that says how many shells are left, where there are fewer than before: "1 shell instead of 2:
/// some vanished or merged".
std::string shells_text(const RoundedSolid& rounded);

/// Rounds the vertices of a solid to a grid, and proves the result (docs/set-operations.md, "Rounding of solids").
/// Parts thinner than the grid vanish. Only faces near vertices that move are changed and proved; if that fails, or if
/// these are more than half of all faces, the whole solid is rounded.
///
/// A ladder of methods is tried in order, and the first proved result is taken (the table in
/// detail/rounding_ladder.cpp; in words `rounding_rungs`). If features were joined or facets made coplanar and that
/// moves by more than 64 spacings, faces are thickened, too, and the nearer result is taken. The last rung, the cubes
/// that meet the solid, cannot fail.
///
/// A simpler form of each result is proved first: without corners of facets with moved corners that lie on the surface
/// or on an edge of it within two spacings (vertex_removal.h); on a grid of multiples 0.9 of one, and only if the grid
/// is fine for the solid. A result is missing only if a coordinate is out of range. It is empty only where nothing is
/// left within a reach of two spacings, and no cell of the grid is found within the solid. The monitor may end the call
/// with the error interrupted, and receives the methods that are tried. Exactness: rounded; validity is exact.
/// Deterministic. Errors: interrupted, limit_exceeded. Cost: for nearly all solids a scan, and snap rounding and a
/// proof of the faces near vertices that move. Source: snap rounding after [hobby1999] and [halperin2002].
Result<RoundedSolid> rounded_solid(const TriangleMesh& solid, const CoordinateGrid& grid, const Monitor& monitor = {});

}  // namespace algebra3d
