#include "algebra3d/kernel/search/boxes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace algebra3d {

Box3 box_of_triangle(const TriangleRef& corners) {
  Box3 box;
  for (const PointRef& corner : corners) box.extend(box_of(corner));
  return box;
}

Box3 padded(const Box3& box, double by) {
  Box3 result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.min[axis] = std::nextafter(box.min[axis] - by, -Box3::kInfinity);
    result.max[axis] = std::nextafter(box.max[axis] + by, Box3::kInfinity);
  }
  return result;
}

double largest_coordinate(const TriangleMesh& mesh) {
  double largest = 0;
  for (const Vec3& p : mesh.points().approx())
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest;
}

}  // namespace algebra3d
