#pragma once

#include <cmath>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/repair/amount.h"
#include "algebra3d/kernel/repair/detail/convex_polygon.h"

namespace algebra3d {

/// A power of two that scales coordinates to about 1, so that their products neither overflow nor vanish.
class BinaryScale {
 public:
  BinaryScale() = default;
  /// For coordinates up to `largest`.
  explicit BinaryScale(double largest) {
    if (largest > 0) std::frexp(largest, &exponent_);
  }

  /// Coordinates and lengths, scaled, and back.
  Vec3 scaled(const Vec3& p) const { return times(p, -exponent_); }
  double scaled(double length) const { return std::ldexp(length, -exponent_); }
  Vec3 unscaled(const Vec3& p) const { return times(p, exponent_); }
  double unscaled(double length) const { return std::ldexp(length, exponent_); }
  /// An area of scaled triangles as that of the triangles themselves.
  Amount area(double a) const { return {a, 2 * exponent_}; }

  /// The corners of a face, scaled; rounded if they are not doubles.
  Triangle3 scaled(const TriangleMesh& mesh, FaceId face) const {
    const TriangleRef corners = mesh.corners(face);
    return {scaled(corners[0].approx), scaled(corners[1].approx), scaled(corners[2].approx)};
  }

 private:
  static Vec3 times(const Vec3& p, int exponent) {
    return {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
  }

  int exponent_ = 0;
};

/// The area of all faces together; rounded.
inline Amount area_of(const TriangleMesh& mesh, const BinaryScale& scale) {
  double sum = 0;
  for (const FaceId face : faces(mesh)) sum += area_of(scale.scaled(mesh, face));
  return scale.area(sum);
}

}  // namespace algebra3d
