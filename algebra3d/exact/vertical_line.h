#pragma once

#include "algebra3d/exact/predicates.h"

namespace algebra3d {

/// How the vertical line through a point passes a triangle.
struct LineCrossing {
  int sign = 0;  ///< 0: not at all; 1 if the projected triangle turns counter-clockwise (its normal points up), else -1
  int side = 0;  ///< of the point along z: 1 above the place of crossing, -1 below, 0 on it; 0 if there is no crossing
};

/// Crossing of the triangle with the line parallel to the z axis through p, moved by (e, e^2, 0) for an e > 0 smaller
/// than any number: so the line passes no edge and no corner, and goes through exactly one of two triangles that meet
/// in an edge in projection side by side. A triangle of no projected area is never crossed (degenerate ones are
/// allowed). `side` is that of p itself, not of the moved point: side == 0 says that p lies on the triangle. (The
/// converse holds only within: a p on an edge or corner may belong to crossings of the neighbours alone.) The winding
/// number of a closed mesh about a p that lies on none of its triangles is the sum of -side * sign, halved; counted
/// over the triangles above p alone it is the sum of sign over side == -1, below p alone the negated sum over side
/// == 1. Outward orientation gives 1 inside. Exactness: exact. Cost: three orient2d at most without a crossing, one
/// orient3d more with one.
LineCrossing cross_vertical_line(PointRef p, const TriangleRef& triangle);

}  // namespace algebra3d
