#pragma once

#include "algebra3d/base/vec3.h"

namespace algebra3d {

/// A weighted sum of squared distances from planes, as a function of the point: x A x + 2 b x + c with a symmetric A.
/// Rounded. Source: [garland1997].
struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  ///< A
  double x = 0, y = 0, z = 0;                             ///< b
  double c = 0;

  /// Adds the plane of the points p with n p + d = 0, where n has length 1.
  void add_plane(const Vec3& n, double d, double weight) {
    const Vec3 w = weight * n;
    xx += w.x * n.x, xy += w.x * n.y, xz += w.x * n.z;
    yy += w.y * n.y, yz += w.y * n.z, zz += w.z * n.z;
    x += w.x * d, y += w.y * d, z += w.z * d;
    c += weight * d * d;
  }

  Quadric& operator+=(const Quadric& q) {
    xx += q.xx, xy += q.xy, xz += q.xz, yy += q.yy, yz += q.yz, zz += q.zz;
    x += q.x, y += q.y, z += q.z;
    c += q.c;
    return *this;
  }
  friend Quadric operator+(Quadric a, const Quadric& b) { return a += b; }

  /// The sum of the weights.
  double trace() const { return xx + yy + zz; }

  Vec3 product(const Vec3& p) const {
    return {xx * p.x + xy * p.y + xz * p.z, xy * p.x + yy * p.y + yz * p.z, xz * p.x + yz * p.y + zz * p.z};
  }
  /// Not negative.
  double at(const Vec3& p) const {
    const double value = dot(p, product(p)) + 2 * (x * p.x + y * p.y + z * p.z) + c;
    return value > 0 ? value : 0;
  }

  /// The point of the least value, among points that are equally good the one nearest to `near`: the minimum of this
  /// quadric and a small multiple of the squared distance from `near`.
  Vec3 minimum(const Vec3& near) const {
    const double bias = 1e-6 * trace();
    const double a = xx + bias, d = yy + bias, f = zz + bias;
    const Vec3 gradient = product(near) + Vec3{x, y, z};
    // Cofactors of the symmetric matrix.
    const double c00 = d * f - yz * yz, c01 = xz * yz - xy * f, c02 = xy * yz - xz * d;
    const double c11 = a * f - xz * xz, c12 = xy * xz - a * yz, c22 = a * d - xy * xy;
    const double determinant = a * c00 + xy * c01 + xz * c02;
    if (!(determinant > 0)) return near;
    const double scale = -1 / determinant;
    return near + scale * Vec3{c00 * gradient.x + c01 * gradient.y + c02 * gradient.z,
                               c01 * gradient.x + c11 * gradient.y + c12 * gradient.z,
                               c02 * gradient.x + c12 * gradient.y + c22 * gradient.z};
  }
};

}  // namespace algebra3d
