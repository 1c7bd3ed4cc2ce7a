#pragma once

#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "base/wide_vec3.h"

namespace algebra3d {

/// A triangle in coordinates of its own: along its longest side, across it, and out of its plane. Its distances are
/// accurate, to some 2^-60 of the coordinates, also if it is a needle or has no area. Rounded, in long doubles.
class TriangleFrame {
 public:
  using Polygon = std::vector<WideVec3>;  // convex

  explicit TriangleFrame(const TriangleRef& corners);

  long double area() const { return length_ * height_ / 2; }
  long double squared_distance_of(const WideVec3& point) const;
  /// That of the farthest point of a convex polygon.
  long double squared_distance_of(const Polygon& polygon) const;

  /// The part of a polygon near the triangle: not above or below its plane, beyond its sides, or beyond the ends of the
  /// longest one by more than `margin`. The convex parts that are cut off are added to `rest`; one that reaches no
  /// farther than 1.5 margins is not cut off.
  Polygon clip(Polygon polygon, long double margin, std::vector<Polygon>& rest) const;

 private:
  WideVec3 start_, along_, across_, normal_;  // the start of the longest side, and directions
  long double length_, height_, foot_;        // of the longest side; over it; its place along the side
};

}  // namespace algebra3d
