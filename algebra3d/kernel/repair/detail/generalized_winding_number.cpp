#include "algebra3d/kernel/repair/detail/generalized_winding_number.h"

#include <cmath>
#include <numbers>

namespace algebra3d {

double GeneralizedWindingNumbers::at(const Vec3& point) const {
  double sum = 0;
  for (const auto& [i, j, k] : soup_.triangles) {
    const Vec3 a = soup_.points[i] - point, b = soup_.points[j] - point, c = soup_.points[k] - point;
    const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
    const double determinant = dot(a, cross(b, c));
    // Half the solid angle.
    sum += std::atan2(determinant, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  // A normal points away from places that see it from inside.
  return sum / (2 * std::numbers::pi);
}

}  // namespace algebra3d
