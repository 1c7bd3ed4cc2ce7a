#pragma once

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

/// What a filter answers that cannot tell the sign.
inline constexpr int kUndecided = 2;

// Relative error of the determinants below, in terms of the same sum with all signs made positive. A product of three
// differences carries at most 8 roundings of 2^-53 before the last addition, which cannot change a sign, and a product
// of two at most 3 ([shewchuk1997], section 4); the unit more covers the roundings of the bound itself.
inline constexpr double kOrient3dError = 9 * 0x1p-53;
inline constexpr double kOrient2dError = 4 * 0x1p-53;
// An operation that underflows is off by at most 2^-1075, which the further factor may enlarge. The term is far larger,
// so that the bound itself does not have to compute with subnormal numbers, which is slow. An overflow makes the bound
// infinite or NaN, and each comparison false.
inline constexpr double kUnderflowError = 0x1p-1000;

/// The filter of orient3d with what belongs to the plane abc computed once.
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

}  // namespace detail
}  // namespace algebra3d
