#pragma once

#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d {

/// The crossing of a triangle by the vertical line through a point.
struct LineCrossing {
  int sign =
      0;  ///< 0: no crossing; 1 if the projected triangle turns counter-clockwise (its normal points up), else -1
  int side = 0;  ///< side of the point: 1 above the crossing, -1 below, 0 on it; 0 if there is no crossing
};

/// Crosses a triangle with the vertical line through p, perturbed by (e, e^2, 0) for an infinitesimal e > 0. So the
/// line meets no edge and no corner, and passes through exactly one of two triangles that are adjacent in projection. A
/// triangle without projected area is never crossed (degenerate ones are allowed). `side` is that of p itself, not of
/// the perturbed point: side == 0 means that p lies on the triangle. (The converse holds for inner points only: a p on
/// an edge or corner may lie on crossings of the neighbours alone.) The winding number of a closed mesh about a p off
/// its triangles is half the sum of -side * sign; or the sum of sign over side == -1 (triangles above p); or the
/// negated sum over side == 1 (below p). With outward orientation it is 1 inside. Exactness: exact. Cost: three
/// orient2d at most without a crossing, one orient3d more with one.
LineCrossing cross_vertical_line(PointRef p, const TriangleRef& triangle);

}  // namespace algebra3d
