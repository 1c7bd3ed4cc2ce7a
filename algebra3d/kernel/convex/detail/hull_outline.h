#pragma once

#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/convex/detail/direction_search.h"
#include "algebra3d/kernel/convex/detail/planar_extent.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d::detail {

/// A convex hull in doubles, simplified for the searches for enclosing boxes and cylinders: some hundreds of its
/// vertices, relative to a point inside and divided by a unit, so that their size is near 1. Bounds that are proved for
/// these hold for the hull, which contains them.
class HullOutline {
 public:
  /// The hull must not be empty.
  explicit HullOutline(const TriangleMesh& hull);

  /// The unit of length: a power of two.
  double unit() const { return unit_; }
  /// The distance of the farthest point.
  double radius() const { return radius_; }
  /// A radius so that a ball of it is inside the hull.
  double inner_radius() const { return inner_radius_; }
  /// Normals of the largest facets.
  const std::vector<Vec3>& normals() const { return normals_; }
  /// The axis in which the hull is longest or shortest beside the others, whichever is more pronounced.
  const Vec3& main_axis() const { return main_axis_; }

  /// The extent along a direction, and the outline of the projection along it.
  struct View {
    double height = 0;
    std::vector<PlanePoint> outline;  ///< convex
    Vec3 x_axis, y_axis;              ///< of the plane; unit vectors
  };
  View seen_along(const Vec3& direction) const;

 private:
  std::vector<Vec3> points_, normals_;
  double unit_ = 1, radius_ = 0, inner_radius_ = 0;
  Vec3 main_axis_;
};

/// Improves a direction by trying its neighbours, at shrinking distances.
template <typename ValueOf>
FoundDirection polished(FoundDirection best, const ValueOf& value_of) {
  for (int exponent = -4; exponent > -40; --exponent) {
    const double step = std::ldexp(1, exponent);
    const Vec3 u = best.direction;
    const Vec3 across = cross(u, std::abs(u.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
    const Vec3 x = 1 / length(across) * across, y = cross(u, x);
    for (const Vec3& side : {x, y, -1 * x, -1 * y}) {
      const Vec3 moved = u + step * side, direction = 1 / length(moved) * moved;
      const double value = value_of(direction, 0).value;
      if (value < best.value) best = {direction, value, best.lower_bound};
    }
  }
  return best;
}

}  // namespace algebra3d::detail
