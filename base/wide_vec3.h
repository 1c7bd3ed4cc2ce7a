#pragma once

#include <array>
#include <cmath>

#include "algebra3d/base/vec3.h"

namespace algebra3d {

/// Three long doubles. With eleven bits more than doubles they give how far a point is from a long edge to a small part
/// of the spacing of doubles. For choices and for bounds, never for decisions on validity.
struct WideVec3 {
  long double x = 0, y = 0, z = 0;

  WideVec3() = default;
  WideVec3(long double x_, long double y_, long double z_) : x(x_), y(y_), z(z_) {}
  explicit WideVec3(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}

  /// Each coordinate rounded to a double.
  Vec3 rounded() const { return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}; }

  friend WideVec3 operator+(const WideVec3& a, const WideVec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend WideVec3 operator-(const WideVec3& a, const WideVec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend WideVec3 operator*(long double factor, const WideVec3& v) {
    return {factor * v.x, factor * v.y, factor * v.z};
  }
};

inline long double dot(const WideVec3& a, const WideVec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline WideVec3 cross(const WideVec3& a, const WideVec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline long double length(const WideVec3& v) {
  return std::sqrt(dot(v, v));
}

}  // namespace algebra3d
