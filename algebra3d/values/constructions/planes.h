#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {

/// The plane through a point with a normal. Exact. Undefined for the zero vector.
Maybe<Plane3d> plane_through(const Point3d& point, const Vector3d& normal);

/// The plane through a point that two directions span. Exact. Undefined if they are parallel, or one of them is zero.
Maybe<Plane3d> plane_spanned(const Point3d& point, const Vector3d& u, const Vector3d& v);

}  // namespace algebra3d
