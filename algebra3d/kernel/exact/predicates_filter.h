#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "algebra3d/base/vec3.h"

namespace algebra3d {

/// Coordinate plane onto which `orient2d` projects: the two axes kept, in the order of a right-handed system.
enum class Projection : std::uint8_t { yz, zx, xy };

/// First and second axis that a projection keeps (0: x, 1: y, 2: z).
inline constexpr std::size_t first_axis(Projection plane) {
  return plane == Projection::yz ? 1 : plane == Projection::zx ? 2 : 0;
}
inline constexpr std::size_t second_axis(Projection plane) {
  return plane == Projection::yz ? 2 : plane == Projection::zx ? 0 : 1;
}

namespace detail {

/// The answer of a filter that cannot determine the sign.
inline constexpr int kUndecided = 2;

// Error bounds of the determinants below, relative to the same sums with all signs positive. A product of three
// differences has at most 8 roundings of 2^-53 before the last addition, which cannot change a sign, and a product of
// two at most 3 ([shewchuk1997], section 4); one more unit covers the roundings of the bound itself.
inline constexpr double kOrient3dError = 9 * 0x1p-53;
inline constexpr double kOrient2dError = 4 * 0x1p-53;
// An underflow causes an error of at most 2^-1075, which the next factor may enlarge. This term is far larger, so that
// the bound is not computed with subnormal numbers, which is slow. An overflow makes the bound infinite or NaN, so all
// comparisons are false.
inline constexpr double kUnderflowError = 0x1p-1000;

/// The filter of orient3d for a fixed plane abc.
class PlaneFilter {
 public:
  PlaneFilter(const Vec3& a, const Vec3& b, const Vec3& c) : a_(a) {
    const Vec3 u = b - a;
    const Vec3 v = c - a;
    const double yz = u.y * v.z, zy = u.z * v.y;
    const double zx = u.z * v.x, xz = u.x * v.z;
    const double xy = u.x * v.y, yx = u.y * v.x;
    normal_ = {yz - zy, zx - xz, xy - yx};
    magnitude_ = {std::abs(yz) + std::abs(zy), std::abs(zx) + std::abs(xz), std::abs(xy) + std::abs(yx)};
  }

  int side(const Vec3& d) const {
    const Vec3 w = d - a_;
    const Vec3 size{std::abs(w.x), std::abs(w.y), std::abs(w.z)};
    const double determinant = dot(w, normal_);
    const double error = kOrient3dError * dot(size, magnitude_) + kUnderflowError * (1 + (size.x + size.y + size.z));
    if (determinant > error) return 1;
    if (determinant < -error) return -1;
    return kUndecided;
  }
  std::array<int, 3> sides(const std::array<const Vec3*, 3>& points) const {
    return {side(*points[0]), side(*points[1]), side(*points[2])};
  }

 private:
  Vec3 a_;
  Vec3 normal_;
  Vec3 magnitude_;
};

inline int filter_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return PlaneFilter(a, b, c).side(d);
}

inline int filter_orient2d(Projection plane, const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::size_t i = first_axis(plane);
  const std::size_t j = second_axis(plane);
  const double left = (b[i] - a[i]) * (c[j] - a[j]);
  const double right = (b[j] - a[j]) * (c[i] - a[i]);
  const double determinant = left - right;
  const double error = kOrient2dError * (std::abs(left) + std::abs(right)) + kUnderflowError;
  if (determinant > error) return 1;
  if (determinant < -error) return -1;
  return kUndecided;
}

inline double largest(const Vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// A bound of the error of a determinant of three differences of points that are given by their nearest doubles. A
/// difference has an error of at most four roundings of the largest coordinate m, `off` = 2^-51 m; so with differences
/// up to A, B, C, the error of each product of three is less than (A + off)(B + off)(C + off) - ABC, and six of them
/// have fewer than 40 roundings of ABC. `a`, `b` and `c`: A + off, B + off, C + off. Infinite if the determinant, or a
/// part of it, may overflow: these are at most 6abc and 2bc.
inline double error_of_rounded_volume(double a, double b, double c, double off) {
  const double bc = b * c;
  return 7 * off * (a * (b + c) + bc) + 0x1p-50 * (a * (8 * bc)) + kUnderflowError;
}

/// The filter of orient3d for points given by their nearest doubles.
inline int filter_rounded_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double off = 0x1p-51 * std::max({largest(a), largest(b), largest(c), largest(d)});
  const double error = error_of_rounded_volume(largest(u) + off, largest(v) + off, largest(w) + off, off);
  const double determinant = dot(u, cross(v, w));
  if (determinant > error) return 1;
  if (determinant < -error) return -1;
  return kUndecided;
}

/// The side of a plane (a, b, c, -d) on which a point lies, both rounded: coefficients cut off by less than 2^-52 of
/// each, coordinates to nearest.
inline int filter_rounded_side(const std::array<double, 4>& plane, const Vec3& p) {
  const auto& [a, b, c, d] = plane;
  const double x = a * p.x, y = b * p.y, z = c * p.z;
  const double height = x + y + z + d;
  // Besides the errors of the operands three products and sums by 2^-53 each: less than nine times 2^-53 of all terms
  // together. Underflow loses less than 2^-1000.
  const double error = 0x1.4p-50 * (std::abs(x) + std::abs(y) + std::abs(z) + std::abs(d)) + kUnderflowError;
  if (height > error) return 1;
  if (height < -error) return -1;
  return kUndecided;
}

inline int filter_rounded_orient2d(Projection plane, const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::size_t i = first_axis(plane), j = second_axis(plane);
  const auto size = [&](const Vec3& v) { return std::max(std::abs(v[i]), std::abs(v[j])); };
  const Vec3 u = b - a, v = c - a;
  const double off = 0x1p-51 * std::max({size(a), size(b), size(c)});
  const double size_u = size(u) + off, size_v = size(v) + off;
  // Where the determinant may overflow, twice a product does, and makes the bound infinite.
  const double error = 3 * off * (size_u + size_v) + 0x1p-51 * (2 * size_u * size_v) + kUnderflowError;
  const double determinant = u[i] * v[j] - u[j] * v[i];
  if (determinant > error) return 1;
  if (determinant < -error) return -1;
  return kUndecided;
}

}  // namespace detail
}  // namespace algebra3d
