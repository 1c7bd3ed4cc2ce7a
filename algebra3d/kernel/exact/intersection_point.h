#pragma once

#include <optional>

#include "algebra3d/kernel/exact/integer_plane.h"

namespace algebra3d {

/// The intersection of the line through a and b with the plane. They must not be parallel. Exact.
ExactPoint intersect_line_plane(PointRef a, PointRef b, const IntegerPlane& plane);
/// The intersection of the line with the plane of a triangle that is not degenerate. Cost: between doubles half a
/// microsecond, without the plane's coefficients.
ExactPoint intersect_line_plane(PointRef a, PointRef b, const TriangleRef& triangle);

/// The common point of three planes. Their normals must be linearly independent. Exact.
ExactPoint intersect_planes(const IntegerPlane& p, const IntegerPlane& q, const IntegerPlane& r);
/// The common point of any three planes; nothing if their normals are linearly dependent.
std::optional<ExactPoint> common_point(const IntegerPlane& p, const IntegerPlane& q, const IntegerPlane& r);

}  // namespace algebra3d
