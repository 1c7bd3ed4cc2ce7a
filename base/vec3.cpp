#include "algebra3d/base/vec3.h"

#include <cmath>
#include <limits>
#include <ostream>

#include "base/number_text.h"

namespace algebra3d {

// hypot, so that squares that overflow or underflow do no harm. Of infinite sides it is not a number in libstdc++,
// which divides by the largest.
double length(const Vec3& v) {
  const bool is_infinite = std::isinf(v.x) || std::isinf(v.y) || std::isinf(v.z);
  return is_infinite ? std::numeric_limits<double>::infinity() : std::hypot(v.x, v.y, v.z);
}

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::ostream& operator<<(std::ostream& out, const Vec3& v) {
  return out << '(' << real_text(v.x) << ' ' << real_text(v.y) << ' ' << real_text(v.z) << ')';
}

}  // namespace algebra3d
