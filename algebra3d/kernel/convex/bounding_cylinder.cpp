#include "algebra3d/kernel/convex/bounding_cylinder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "algebra3d/kernel/convex/detail/hull_outline.h"
#include "algebra3d/kernel/exact/predicates_filter.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using detail::DirectionValue;
using detail::HullOutline;

/// The volume of the smallest cylinder with an axis.
///
/// The bound for axes within an angle: turning the hull by it moves its points by at most radius * angle, so the radius
/// of the circle around the projection changes by as much at most, and the height by twice that. Besides, the inner
/// ball must fit.
class CylinderVolume {
 public:
  explicit CylinderVolume(const HullOutline& hull) : hull_(hull) {}

  DirectionValue operator()(const Vec3& axis, double angle) const {
    constexpr double kRoundings = 1 - 0x1p-36;
    const HullOutline::View view = hull_.seen_along(axis);
    const double radius = smallest_circle(view.outline).radius, shift = hull_.radius() * angle;
    const double least_radius = std::max(radius - shift, hull_.inner_radius());
    const double least_height = std::max(view.height - 2 * shift, 2 * hull_.inner_radius());
    return {volume(radius, view.height), kRoundings * volume(least_radius, least_height)};
  }

  static double volume(double radius, double height) { return std::numbers::pi * radius * radius * height; }

 private:
  const HullOutline& hull_;
};

/// The cylinder along an axis around all points.
Cylinder cylinder_along(const Vec3& axis, const PointArray& points) {
  const Vec3 across = cross(axis, std::abs(axis.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  const Vec3 x = 1 / length(across) * across, y = cross(axis, x), origin = points[0].approx;
  double low = std::numeric_limits<double>::infinity(), high = -low, size = 0, coordinates = 0;
  std::vector<detail::PlanePoint> projected;
  for (const Vec3& p : points.approx()) {
    const Vec3 relative = p - origin;
    projected.push_back({dot(relative, x), dot(relative, y)});
    const double height = dot(relative, axis);
    low = std::min(low, height), high = std::max(high, height);
    size = std::max(size, detail::largest(relative));
    coordinates = std::max(coordinates, detail::largest(p));
  }
  const detail::PlaneCircle circle = smallest_circle(planar_hull(projected));
  double radius = 0;
  for (const detail::PlanePoint& p : projected)
    radius = std::max(radius, std::hypot(p.x - circle.centre.x, p.y - circle.centre.y));
  const double underflow = 16 * std::numeric_limits<double>::denorm_min();
  const double margin = 0x1p-40 * size + 0x1p-50 * coordinates + underflow;
  const Vec3 base = origin + circle.centre.x * x + circle.centre.y * y + (low - margin) * axis;
  return {base, axis, radius + margin, (high - low) + 2 * margin, 0};
}

}  // namespace

Result<std::optional<Cylinder>> bounding_cylinder(const TriangleMesh& hull, const Monitor& monitor) {
  const HullOutline outline(hull);
  const CylinderVolume volume_of(outline);
  detail::FoundDirection best;
  for (const Vec3& normal : outline.normals())
    if (const double value = volume_of(normal, 0).value; value < best.value) best = {normal, value, 0};
  detail::DirectionSearch search(
      {.middle = outline.main_axis(), .angle = std::numbers::pi / 2, .ratio = 1.05 - 0x1p-20, .budget = 5000});
  A3D_ASSIGN(best, search.run(best, volume_of, monitor));
  best = polished(best, volume_of);
  Cylinder cylinder = cylinder_along(best.direction, hull.points());
  if (!is_finite(cylinder.base) || !std::isfinite(cylinder.radius) || !std::isfinite(cylinder.height))
    return std::optional<Cylinder>();
  const double volume = CylinderVolume::volume(cylinder.radius / outline.unit(), cylinder.height / outline.unit());
  cylinder.ratio = std::max(1.0, (1 + 0x1p-40) * volume / best.lower_bound);
  return std::optional(cylinder);
}

}  // namespace algebra3d
