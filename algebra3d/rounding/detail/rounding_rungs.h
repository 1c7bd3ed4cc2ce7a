#pragma once

#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/rounding/detail/rounding_job.h"

namespace algebra3d {

/// The rungs of the ladder between snap rounding and the cover of cubes. Each makes candidates until the job accepts
/// one; false if it accepts none. All but join_features are for whole solids. Errors: interrupted, limit_exceeded.

/// The rung that moves least: vertices move and no edge is led round any, then cells are selected, a few times. Best
/// where the grid is coarse for the solid; where long thin triangles cross, they multiply.
Result<bool> divide_at_crossings(RoundingJob& job);

/// Joins features that are nearly one, up to a reach in spacings of the grid, and selects cells, in turns, as long as
/// no more than some half of the crossings are left.
Result<bool> join_features(RoundingJob& job, RoundingCandidate candidate, double largest_reach);

/// Which vertices of the solid are corners of triangles that cross others after snap rounding.
Result<std::vector<bool>> crowded_vertices(const RoundingJob& job, const TriangleMesh& snapped);

/// Makes crowded facets exactly coplanar with others nearer than `reach`: facets that nearly lie upon each other and
/// are large have no near features. Then joins features. False also if there are no such facets, or too many.
Result<bool> join_coplanar(RoundingJob& job, const std::vector<bool>& crowded, double reach, double largest_reach);

}  // namespace algebra3d
