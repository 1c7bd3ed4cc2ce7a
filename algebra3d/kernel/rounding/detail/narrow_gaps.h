#pragma once

#include <cstddef>
#include <optional>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/detail/rounded_vertices.h"

namespace algebra3d {

/// A mesh without the walls of its narrow gaps, and the places to which its vertices move. It is closed after they have
/// moved, not before where a gap is open at its rim.
struct ClosedGaps {
  TriangleMesh mesh;
  RoundedVertices vertices;
  PointTable rims;        ///< the places of all corners of the walls that went
  std::size_t count = 0;  ///< of the gaps
};

/// Takes away the walls of gaps in a solid that are nowhere wider than `spacing`: hollow pockets, and slits that are
/// open at a rim. Faces are walls of a gap if all of their points have a face opposite within it, with nothing of the
/// solid between them. Walls go together, and only if the rims of both sides come to lie upon each other when the
/// vertices move; vertices of walls that lie as near to each other as these do move to one place for that, if this
/// takes none of them farther than a spacing in each coordinate. So a face opposite to which there is a wall on a part
/// of it only stays, and the gap with it.
///
/// Nothing if no gap is found, or if so many faces lie near each other that the search would take too long. Rounded
/// arithmetic, in long doubles: whether a gap counts as narrow is not exact. Whether the result is valid is left to its
/// proof. Deterministic. Errors: interrupted. Cost: that of the pairs of faces within the spacing, at most 16 for each.
Result<std::optional<ClosedGaps>> with_closed_gaps(const TriangleMesh& solid, const RoundedVertices& vertices,
                                                   double spacing, const Monitor& monitor);

}  // namespace algebra3d
