#pragma once

#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/congruence/detail/centred_solid.h"
#include "algebra3d/kernel/congruence/detail/rotation.h"

namespace algebra3d::detail {

/// Rotations, and rotations with a reflection, about the centre of mass that may carry one solid onto another, within a
/// tolerance: rotations first, then by ascending angle.
///
/// Distinct principal moments: axes go to axes, with all signs. Otherwise a direction goes to a direction (that of the
/// distinct moment, or that of the vertex farthest from the centre), and a corner far from its line to a vertex at the
/// same height and distance. Where many vertices are as far from the centre as the farthest, as those of a sphere are,
/// the closest two of them go to pairs of such vertices at the same distance. Such points are corners in every
/// triangulation, so all symmetric cases are found. Errors: interrupted. Cost: linear; for each vertex as far from the
/// centre as the farthest if they are few, or if two of them are nearer to each other than 16 times the tolerance.
Result<std::vector<Rotation>> candidate_rotations(const CentredSolid& from, const CentredSolid& to, double tolerance,
                                                  const Monitor& monitor);

}  // namespace algebra3d::detail
