#include "algebra3d/base/vec3.h"

#include <cmath>
#include <ostream>

#include "algebra3d/base/number_text.h"

namespace algebra3d {

double length(const Vec3& v) {
  return std::hypot(v.x, v.y, v.z);
}

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::ostream& operator<<(std::ostream& out, const Vec3& v) {
  return out << '(' << real_text(v.x) << ' ' << real_text(v.y) << ' ' << real_text(v.z) << ')';
}

}  // namespace algebra3d
