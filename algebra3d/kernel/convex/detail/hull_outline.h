#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <queue>
#include <span>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d::detail {

/// A point of a plane, in doubles.
struct PlanePoint {
  double x = 0, y = 0;
};

/// The convex hull of points of a plane, counter-clockwise, rounded. Cost: n log n.
std::vector<PlanePoint> planar_hull(std::vector<PlanePoint> points);

/// The rectangle of the smallest area around a convex polygon: the direction of one side, and its area. One side lies
/// on an edge of the polygon. Source: [freeman1975]. Cost: quadratic in the corners.
struct PlaneRectangle {
  PlanePoint direction{1, 0};  ///< a unit vector
  double area = 0;
};
PlaneRectangle smallest_rectangle(std::span<const PlanePoint> hull);

/// The largest distance of two points. Cost: quadratic.
double diameter(std::span<const PlanePoint> hull);

/// The smallest circle around points, rounded.
struct PlaneCircle {
  PlanePoint centre;
  double radius = 0;
};
PlaneCircle smallest_circle(std::span<const PlanePoint> points);

/// The value of a direction, and a lower bound of the values of all directions within an angle of it.
struct DirectionValue {
  double value = 0;
  double lower_bound = 0;
};

struct FoundDirection {
  Vec3 direction;
  double value = std::numeric_limits<double>::infinity();
  double lower_bound = 0;  ///< of all directions
};

/// Where and how long directions are searched.
struct DirectionRange {
  Vec3 middle;             ///< a unit vector
  double angle = 0;        ///< from the middle, in radians; directions and their opposites are the same
  double ratio = 1;        ///< the search ends when the value is at most this ratio of the lower bound,
  std::size_t budget = 0;  ///< or after so many divisions
};

/// Branch and bound over spherical triangles: the one with the lowest bound is divided in four.
class DirectionSearch {
 public:
  explicit DirectionSearch(const DirectionRange& range) : range_(range) {}

  /// value_of(direction, angle) returns a DirectionValue. `best` is a known value. Errors: interrupted.
  template <typename ValueOf>
  Result<FoundDirection> run(FoundDirection best, const ValueOf& value_of, const Monitor& monitor) {
    best_ = best;
    for (const auto& corners : half_octahedron()) look(corners, value_of);
    Stage stage(monitor, "searching directions", range_.budget);
    for (std::size_t steps = 0; steps < range_.budget && !cells_.empty(); ++steps) {
      if (!stage.begin_step()) return Monitor::interrupted();
      const auto [a, b, c] = cells_.top().corners;
      if (best_.value <= range_.ratio * cells_.top().lower_bound) break;
      cells_.pop();
      const Vec3 ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const auto& corners : {Corners{a, ab, ca}, Corners{ab, b, bc}, Corners{ca, bc, c}, Corners{ab, bc, ca}})
        look(corners, value_of);
    }
    best_.lower_bound = std::min(least_dropped_, best_.value);
    if (!cells_.empty()) best_.lower_bound = std::min(best_.lower_bound, cells_.top().lower_bound);
    return best_;
  }

 private:
  using Corners = std::array<Vec3, 3>;
  struct Cell {
    double lower_bound;
    Corners corners;
    friend bool operator<(const Cell& a, const Cell& b) { return a.lower_bound > b.lower_bound; }
  };

  static Vec3 unit(const Vec3& v) { return 1 / length(v) * v; }
  static Vec3 middle(const Vec3& a, const Vec3& b) { return unit(a + b); }

  /// The four faces of an octahedron on the side of the middle.
  std::array<Corners, 4> half_octahedron() const {
    const Vec3 z = range_.middle;
    const Vec3 x = unit(cross(z, std::abs(z.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0})), y = cross(z, x);
    return {{{x, y, z}, {y, -1 * x, z}, {-1 * x, -1 * y, z}, {-1 * y, x, z}}};
  }

  /// Values the centre of a triangle, and keeps the triangle if it may hold something better.
  template <typename ValueOf>
  void look(const Corners& corners, const ValueOf& value_of) {
    const Vec3 centre = unit(corners[0] + corners[1] + corners[2]);
    double angle = 0;
    for (const Vec3& corner : corners) angle = std::max(angle, 2 * std::asin(length(corner - centre) / 2));
    angle *= 1 + 0x1p-40;  // for roundings
    if (2 * std::asin(std::min(1.0, length(centre - range_.middle) / 2)) > range_.angle + angle) return;
    const DirectionValue found = value_of(centre, angle);
    if (found.value < best_.value) best_ = {centre, found.value, 0};
    if (found.lower_bound * range_.ratio < best_.value)
      cells_.push({found.lower_bound, corners});
    else
      least_dropped_ = std::min(least_dropped_, found.lower_bound);
  }

  DirectionRange range_;
  FoundDirection best_;
  double least_dropped_ =  // bound of triangles that cannot hold anything better than the ratio allows
      std::numeric_limits<double>::infinity();
  std::priority_queue<Cell> cells_;
};

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
