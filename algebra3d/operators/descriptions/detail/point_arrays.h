#pragma once

#include <utility>
#include <vector>

#include "algebra3d/kernel/convex/convex_hull.h"
#include "algebra3d/values/types/spatial.h"
#include "base/box_corners.h"

// Values as points whose convex hull is that of the value.

namespace algebra3d {

inline PointArray spanning_points(const Points3d& set) {
  PointArray points;
  points.reserve(set.points().size());
  for (const ExactPoint& point : set.points()) points.push_back(point);
  return points;
}
inline PointArray spanning_points(const Surface3d& surface) {
  return used_points(surface.mesh());
}
inline PointArray spanning_points(const Volume3d& solid) {
  return used_points(solid.mesh());
}
inline PointArray spanning_points(const Box3& box) {
  std::vector<Vec3> corners;
  for (unsigned i = 0; i < 8; ++i) corners.push_back(corner_of(box, i));
  return PointArray(std::move(corners));
}

}  // namespace algebra3d
