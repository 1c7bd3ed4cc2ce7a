#include "algebra3d/halfedge/boxes.h"

#include <cmath>

namespace algebra3d {
namespace {

/// Around a point that is no double: each coordinate lies within half a step of its rounded one.
Box3 box_around(const Vec3& rounded) {
  Box3 box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::nextafter(rounded[axis], -Box3::kInfinity);
    box.max[axis] = std::nextafter(rounded[axis], Box3::kInfinity);
  }
  return box;
}

}  // namespace

Box3 box_of_point(const PointRef& point) {
  return point.is_double() ? Box3::of(point.approx) : box_around(point.approx);
}

Box3 box_of_triangle(const TriangleRef& corners) {
  Box3 box;
  for (const PointRef& corner : corners)
    if (corner.is_double())
      box.extend(corner.approx);
    else
      box.extend(box_around(corner.approx));
  return box;
}

}  // namespace algebra3d
