#pragma once

#include <algorithm>
#include <cmath>

#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/repair/amount.h"
#include "algebra3d/repair/convex_polygon.h"

namespace algebra3d {

/// A scale by a power of two that brings coordinates near 1, so that no product of them overflows or vanishes.
class BinaryScale {
 public:
  BinaryScale() = default;
  /// For coordinates up to that size.
  explicit BinaryScale(double largest) {
    if (largest > 0) std::frexp(largest, &exponent_);
  }

  Vec3 scaled(const Vec3& p) const { return times(p, -exponent_); }
  double scaled(double length) const { return std::ldexp(length, -exponent_); }
  Vec3 point(const Vec3& p) const { return times(p, exponent_); }
  double length(double l) const { return std::ldexp(l, exponent_); }
  Amount area(double a) const { return {a, 2 * exponent_}; }

  Triangle3 scaled(const TriangleMesh& mesh, std::uint32_t face) const {
    const TriangleRef corners = mesh.corners(FaceId(face));
    return {scaled(corners[0].approx), scaled(corners[1].approx), scaled(corners[2].approx)};
  }

 private:
  static Vec3 times(const Vec3& p, int exponent) {
    return {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
  }

  int exponent_ = 0;
};

/// The sum over all faces, rounded.
inline Amount area_of(const TriangleMesh& mesh, const BinaryScale& scale) {
  double sum = 0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) sum += area_of(scale.scaled(mesh, f));
  return scale.area(sum);
}

/// The largest size of a coordinate.
inline double largest_coordinate(const TriangleMesh& mesh) {
  double largest = 0;
  for (const Vec3& p : mesh.points().approx())
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest;
}

}  // namespace algebra3d
