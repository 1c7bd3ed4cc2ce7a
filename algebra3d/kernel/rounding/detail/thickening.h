#pragma once

#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/rounding/detail/rounding_job.h"

namespace algebra3d {

/// How coarse the lattices are on which faces are thickened, as powers of two, in spacings of the grid.
struct ThickeningSteps {
  int first, last, step;
};

/// The rung for solids whose walls nearly coincide in many places, such as rounded shells a few spacings thick that are
/// subtracted from themselves. Whole shells with crowded vertices lose the corners that are within a cell of their
/// surface (vertex_removal.h, thin triangles allowed), and are put on a lattice of cubes, which makes one of corners
/// that are near each other; prisms are added over their faces (thickened_faces.h), so that no wall vanishes. What
/// crosses is divided exactly. Since the corners of mesh and prisms are many spacings apart, the new ones are rounded
/// more easily than those of the given solid; after that corners are removed again, and few features are left to join.
/// Lattices get coarser until the job accepts a candidate, or until fewer than a thousand cells fit into the solid;
/// false if it accepts none. `crowded`: per vertex of the job's mesh. The distance of a candidate from the given
/// boundary is bounded once it exists (distance/covering_bound.h): some two to four cells, 64 at most, plus the
/// movement by joining. For the whole of a solid. Errors: interrupted, limit_exceeded. Cost: some ten times that of a
/// proof for each lattice, and more where many prisms overlap.
Result<bool> thicken_faces(RoundingJob& job, const std::vector<bool>& crowded, const ThickeningSteps& steps);

}  // namespace algebra3d
