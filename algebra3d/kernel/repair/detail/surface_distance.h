#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/repair/detail/convex_polygon.h"
#include "rtree/rtree.h"

namespace algebra3d {

/// Bounds of a one-sided Hausdorff distance: the largest distance of a point of some triangles from a surface.
struct FarthestBounds {
  double at_least = 0, at_most = 0;
  Vec3 where;  ///< a point that is `at_least` away
};

/// Computes distances from a surface of triangles. Rounded. Source: [guthe2005] for the bounds.
class SurfaceDistance {
 public:
  /// Cost: n log n.
  explicit SurfaceDistance(std::vector<Triangle3> triangles);

  bool is_empty() const { return triangles_.empty(); }
  /// The distance of a point; infinite if the surface is empty.
  double to(const Vec3& point) const { return nearest(point).distance; }
  /// True if every point of the triangle is proved to be within `distance` of the surface. False if one is farther, or
  /// if the proof would take too long.
  bool is_near(const Triangle3& triangle, double distance) const;
  /// The point of the triangles that is farthest from the surface. The bounds differ by at most a hundredth, unless
  /// that takes more than 40,000 searches besides one for each triangle.
  FarthestBounds farthest(std::span<const Triangle3> triangles) const;

 private:
  struct Nearest {
    double distance;
    std::uint32_t triangle;
  };

  Nearest nearest(const Vec3& point) const;
  enum class Nearness : std::uint8_t { near, far, unknown };
  Nearness nearness(const Triangle3& triangle, double distance) const;
  /// Bounds of the largest distance of a point of the triangle, from one search.
  FarthestBounds bounds(const Triangle3& triangle) const;

  std::vector<Triangle3> triangles_;
  rtree::RTree<std::uint32_t> tree_;
};

}  // namespace algebra3d
