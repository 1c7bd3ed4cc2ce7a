#pragma once

#include "algebra3d/kernel/exact/point.h"

namespace algebra3d {

/// The point of the plane z = 0 lifted to `height`.
inline ExactPoint at_height(const PointRef& point, double height) {
  if (point.is_double()) return ExactPoint(Vec3{point.approx.x, point.approx.y, height});
  return ExactPoint(RationalVec3(point.coordinate(0), point.coordinate(1), Rational(height)));
}

inline void add_at_height(const PointArray& from, double height, PointArray& points) {
  for (std::size_t i = 0; i < from.size(); ++i) points.push_back(at_height(from[i], height));
}

}  // namespace algebra3d
