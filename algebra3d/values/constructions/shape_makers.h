#pragma once

#include <cstdint>

#include "algebra3d/base/error.h"
#include "algebra3d/values/types/spatial.h"
#include "base/context.h"

namespace algebra3d {

// Solids of simple form. Coordinates of the round ones are rounded once. Undefined, with the reason, where a length is
// not positive, for fewer than 3 corners or more than 10 million, and where the shape collapses when its corners are
// rounded to doubles. Errors: limit_exceeded if the memory for the triangles is not left; interrupted. Cost: linear in
// the number of triangles.

/// The axis-parallel box between two corners, given in any order, as 12 triangles. Exact. Undefined if the box has no
/// extent along an axis.
Result<Maybe<Volume3d>> box_between(Context& context, const Point3d& p, const Point3d& q);

/// The prism of that height over a regular polygon in the horizontal plane of `base`, its centre, with its first corner
/// in direction +x: 4n - 4 triangles for n corners.
Result<Maybe<Volume3d>> upright_prism(Context& context, const Point3d& base, double radius, double height,
                                      std::int64_t corners);

/// The pyramid over such a polygon, with its apex above the centre: 2n - 2 triangles.
Result<Maybe<Volume3d>> upright_pyramid(Context& context, const Point3d& base, double radius, double height,
                                        std::int64_t corners);

/// A polyhedron with its corners on a sphere, up to rounding: n(n - 2) triangles, at most 40 million, for n corners of
/// its circles; an odd n is increased by 1. A half circle of n/2 steps from +x to -x is turned about the x axis in n
/// steps.
Result<Maybe<Volume3d>> sphere_polyhedron(Context& context, const Point3d& centre, double radius, std::int64_t corners);

}  // namespace algebra3d
