#pragma once

#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/planar/moving_polygons.h"

namespace algebra3d {

/// Polygons that move while time, which is the third axis, runs from one height to another.
struct MovingSlab {
  const MovingPolygons* polygons;
  double from, to;  ///< from < to
};

/// The solid that the polygons sweep, which are a valid region at every instant between the two (moving_polygons.h).
/// Below and above it is bounded by the regions at the ends, and on its sides by two triangles for each moving segment,
/// or one where an end of the segment's way is a single point. The diagonal begins at that start corner which comes
/// first in the order of coordinates, so that neighbours agree. The sides of a segment that turns are no plane: a cut
/// at the fraction s of the height then lies within s (1 - s) |q - p| of the moving segment, with p and q the vectors
/// from one of its ends to the other before and after.
/// Undefined if the sides pass through one another. The result is a valid volume. Exactness: exact.
/// Errors: interrupted, limit_exceeded. Cost: n log n.
Result<Maybe<TriangleMesh>> swept_solid(const MovingSlab& slab, const Monitor& monitor = {});

}  // namespace algebra3d
