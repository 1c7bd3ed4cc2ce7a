#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/repair/convex_polygon.h"
#include "rtree/rtree.h"

namespace algebra3d {

/// The largest distance of points of some triangles from a surface, the one-sided Hausdorff distance: between two
/// bounds.
struct FarthestPoint {
  double at_least = 0, at_most = 0;
  Vec3 where;  ///< a point that is `at_least` away
};

/// Distances from a surface of triangles. Rounded. Source: [guthe2005] for the bounds.
class SurfaceDistance {
 public:
  explicit SurfaceDistance(std::vector<Triangle3> triangles);

  bool is_empty() const { return triangles_.empty(); }
  double to(const Vec3& point) const { return nearest(point).distance; }
  /// True if all points of the triangle are known to be no farther than that from the surface; false if one is
  /// farther, or if that would take too long to find out.
  bool is_near(const Triangle3& triangle, double distance) const;
  /// The point of the triangles farthest from the surface. The bounds are no more than a hundredth of the distance
  /// apart, unless that takes more than some ten thousand looks at the surface.
  FarthestPoint farthest(std::span<const Triangle3> triangles) const;

 private:
  struct Nearest {
    double distance;
    std::uint32_t triangle;
  };

  Nearest nearest(const Vec3& point) const;
  /// Bounds on the largest distance of a point of the triangle, as one look at the surface gives them.
  FarthestPoint bounds(const Triangle3& triangle) const;

  std::vector<Triangle3> triangles_;
  rtree::RTree<std::uint32_t> tree_;
};

}  // namespace algebra3d
