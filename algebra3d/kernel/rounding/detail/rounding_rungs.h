#pragma once

#include <atomic>
#include <cstddef>
#include <optional>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/coordinate_grid.h"
#include "algebra3d/kernel/rounding/detail/rounding_job.h"

namespace algebra3d {

/// The rungs of the ladder above snap rounding (rung, reach, turn: docs/architecture.md, "Words"). Each makes
/// candidates until the job accepts one; false if it accepts none. All but join_features demand the whole mesh. Errors:
/// interrupted, limit_exceeded.

/// The rung that moves least: the candidate is divided at its crossings and new corners are rounded, a few times. Best
/// where the grid is coarse for the given mesh; where long thin triangles cross, they multiply.
Result<bool> divide_at_crossings(RoundingJob& job, RoundingCandidate candidate);

/// The reaches within which features are joined, in spacings of the grid: the first one, and the widest one, which is
/// used for the last few crossings if their number no longer falls.
struct JoiningReach {
  double first, last;
  bool must_fall = false;  ///< crossings must become fewer from turn to turn, however few are left
  /// How much work of feature snapping (FeatureSnappedMesh::work) may be done for each triangle of what is given.
  std::size_t most_work = 32;
};

/// Joins features that are nearly one, and divides at crossings, in turns, as long as no more than some half of the
/// crossings are left.
Result<bool> join_features(RoundingJob& job, RoundingCandidate candidate, const JoiningReach& reach);

/// Which vertices of the mesh are corners of triangles that cross others after snap rounding.
Result<std::vector<bool>> crowded_vertices(const RoundingJob& job, const TriangleMesh& snapped);

/// Makes crowded facets exactly coplanar with others nearer than a reach, in spacings of the grid, at first
/// `first_reach`, which grows from attempt to attempt: facets that nearly lie upon each other and are large have no
/// near features. Then joins features. False also if there are no such facets, or too many; of many triangles only the
/// first reach is tried.
Result<bool> join_coplanar(RoundingJob& job, const std::vector<bool>& crowded, double first_reach,
                           double largest_reach);

/// The cubes of a lattice that meet a solid, in place of it (cell_cover.h): as fine as a number of cubes at its
/// boundary allows, and no finer than the grid. Never empty, valid by construction, and contains the solid. None if the
/// solid reaches beyond the largest number of the grid. Errors: interrupted. Cost: microseconds per cube.
Result<std::optional<RoundingCandidate>> cover_of_cubes(const TriangleMesh& solid, const CoordinateGrid& grid,
                                                        std::size_t budget, const std::atomic<bool>* cancel);

}  // namespace algebra3d
