#include "algebra3d/repair/winding_number.h"

#include <cmath>
#include <numbers>

namespace algebra3d {

double WindingNumbers::at(const Vec3& point) const {
  double sum = 0;
  for (const auto& [i, j, k] : facets_.triangles) {
    const Vec3 a = facets_.points[i] - point, b = facets_.points[j] - point, c = facets_.points[k] - point;
    const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
    const double determinant = dot(a, cross(b, c));
    // Half the solid angle.
    sum += std::atan2(determinant, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  // A normal points away from what it is seen from inside.
  return sum / (2 * std::numbers::pi);
}

}  // namespace algebra3d
