#include "algebra3d/base/vec3.h"

#include <cmath>

namespace algebra3d {

double length(const Vec3& v) {
  return std::hypot(v.x, v.y, v.z);
}

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace algebra3d
