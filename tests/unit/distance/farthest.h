#pragma once

#include "algebra3d/kernel/distance/farthest_point.h"
#include "unit/distance/triangle_set.h"

namespace algebra3d {

/// The point of one set that is farthest from another one.
inline FarthestPoint farthest(const TriangleSet& from, const TriangleSet& to) {
  const FarthestSearch search{from.operand(), to.operand()};
  return farthest_point({&search, 1}).value().value();
}

inline double distance_of(const FarthestPoint& farthest) {
  return farthest.squared_distance.nearest_root();
}

}  // namespace algebra3d
