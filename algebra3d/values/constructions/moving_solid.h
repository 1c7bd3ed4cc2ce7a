#pragma once

#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/planar/moving_polygons.h"

namespace algebra3d {

/// Moving polygons over a span of time; time is the third axis.
struct MovingSlab {
  const MovingPolygons* polygons;
  double from, to;  ///< from < to
};

/// The solid that moving polygons sweep. Domain: the polygons are a valid region at every instant between the ends
/// (moving_polygons.h). The solid is bounded by the regions at both ends, and on its sides by two triangles per moving
/// segment, or one if the segment collapses to a point at one end. The diagonal begins at the lexicographically first
/// start corner, so that neighbours agree. The side of a segment that turns is not planar: a cut at the fraction s of
/// the height lies within s (1 - s) |q - p| of the moving segment, where p and q are its vectors at the two ends.
/// Undefined if sides cross each other. The result is a valid volume. Exactness: exact. Errors: interrupted,
/// limit_exceeded. Cost: n log n.
Result<Maybe<TriangleMesh>> swept_solid(const MovingSlab& slab, const Monitor& monitor = {});

}  // namespace algebra3d
