#pragma once

#include <compare>
#include <cstddef>
#include <functional>
#include <iosfwd>

namespace algebra3d {

/// Three doubles: a position or a direction. No invariant; lexicographic order.
struct Vec3 {
  double x = 0;
  double y = 0;
  double z = 0;

  double operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  double& operator[](std::size_t axis) { return axis == 0 ? x : axis == 1 ? y : z; }

  friend auto operator<=>(const Vec3&, const Vec3&) = default;
  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator*(double factor, const Vec3& v) { return {factor * v.x, factor * v.y, factor * v.z}; }
};

/// Rounded in every operation: only for display and filters, never for decisions.
inline double dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The length, rounded; intermediate results do not over- or underflow.
double length(const Vec3& v);

/// True if no coordinate is NaN or infinite.
bool is_finite(const Vec3& v);

/// Prints `(1.0 0.5 0.0)`, the shortest decimals that read back as the same doubles.
std::ostream& operator<<(std::ostream& out, const Vec3& v);

}  // namespace algebra3d

template <>
struct std::hash<algebra3d::Vec3> {
  std::size_t operator()(const algebra3d::Vec3& v) const {
    const std::hash<double> hash_of;  // of 0.0 and -0.0, which are equal, the same
    return (hash_of(v.x) * 31 + hash_of(v.y)) * 31 + hash_of(v.z);
  }
};
