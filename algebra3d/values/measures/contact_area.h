#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {

/// The area of the intersection of two surfaces, or of the boundaries of two solids, in squared coordinate units;
/// infinite beyond the range of doubles. Triangles have an area in common only if they are coplanar, which is decided
/// exactly. Exactness: the area in each triangle of `a` is the root of an exact number with a relative error below
/// 2^-100, and their sum is rounded once. Errors: interrupted. Cost: that of the pairs of triangles whose boxes meet;
/// some microseconds for each pair with a common area.
Result<double> contact_area(const Geometry& a, const Geometry& b, const Monitor& monitor = {});

}  // namespace algebra3d
