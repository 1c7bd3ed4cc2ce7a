#pragma once

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d::distances {

/// A closed half-space: the side of the plane through a point to which the normal points. The normal may be 0: then all
/// points are in it.
class HalfSpace {
 public:
  HalfSpace(RationalVec3 point, RationalVec3 normal);

  /// Exact. Cost: some nanoseconds, unless the point is next to the plane: then some rational operations.
  bool has(const PointRef& point) const;

 private:
  RationalVec3 point_, normal_;
  Vec3 rounded_point_, rounded_normal_;
};

}  // namespace algebra3d::distances
