#pragma once

#include "algebra3d/exact/plane.h"
#include "algebra3d/exact/predicates.h"

namespace algebra3d {

/// The plane through the corners of a triangle that is not degenerate, in canonical form: the same for every triangle
/// in it that turns the same way.
ExactPlane plane_through(const TriangleRef& triangle);

/// The point in which the line through a and b meets the plane. They must not be parallel. Exact, in lowest terms.
ExactPoint intersect_line_plane(PointRef a, PointRef b, const ExactPlane& plane);

/// The point that three planes have in common. Their normals must be linearly independent. Exact, in lowest terms.
ExactPoint intersect_planes(const ExactPlane& p, const ExactPlane& q, const ExactPlane& r);

}  // namespace algebra3d
