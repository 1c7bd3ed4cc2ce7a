#pragma once

#include <optional>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// A right circular cylinder: the points p for which (p - base) . axis is between 0 and `height` and whose distance
/// from the line through `base` along `axis` is at most `radius`.
struct Cylinder {
  Vec3 base;  ///< the centre of the lower disc
  Vec3 axis;  ///< a unit vector, rounded
  double radius = 0, height = 0;
  double ratio = 0;  ///< a proved upper bound of its volume by that of the smallest cylinder
};

/// A cylinder with nearly the smallest volume around a convex hull, which must not be empty. It contains the hull:
/// radius and height are enlarged by 2^-40 of the size of the hull, which is more than all roundings, and by the
/// rounding of coordinates that are not doubles or far from the origin. Nothing if it leaves the range of doubles.
/// `ratio` is at most 1.05 where the search ends by itself, as for most sets. Errors: interrupted. Cost: linear, and up
/// to some tenths of a second for the search.
Result<std::optional<Cylinder>> bounding_cylinder(const TriangleMesh& hull, const Monitor& monitor = {});

}  // namespace algebra3d
