#include "algebra3d/kernel/convex/minimal_box.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "algebra3d/kernel/convex/detail/hull_outline.h"
#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/exact/predicates_filter.h"
#include "base/box_corners.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using detail::DirectionValue;
using detail::HullOutline;

constexpr double kRoundings = 1 - 0x1p-36;

/// The volume of the smallest box with a side at a right angle to a direction.
///
/// The bound for directions within an angle: turning the box by it changes the extents of the hull along its sides by
/// at most h = 2 radius * angle. So (a + h)(b + h) is at least the area of the rectangle here for the sides a, b of any
/// rectangle there, and these are at most the diameter d here plus h: a b is least if one of them is that. Besides, no
/// side is shorter than the inner ball is wide, and the longer one is at least the diameter by the root of 2.
class BoxVolume {
 public:
  explicit BoxVolume(const HullOutline& hull) : hull_(hull) {}

  DirectionValue operator()(const Vec3& direction, double angle) const {
    const HullOutline::View view = hull_.seen_along(direction);
    const double area = smallest_rectangle(view.outline).area;
    const double h = 2 * hull_.radius() * angle, width = 2 * hull_.inner_radius(), d = detail::diameter(view.outline);
    const double by_turning = (d + h) * (area / (d + 2 * h) - h);
    const double by_ball = width * std::max(width, (d - h) / std::numbers::sqrt2);
    const double height = std::max({view.height - h, width, 0.0});
    return {view.height * area, kRoundings * height * std::max({by_turning, by_ball, 0.0})};
  }

 private:
  const HullOutline& hull_;
};

/// The quaternion of the rotation that takes the coordinate axes to three orthogonal unit vectors.
std::array<double, 4> quaternion_of(const std::array<Vec3, 3>& axes) {
  const auto& [x, y, z] = axes;
  // The four squares of the parts, times four; the largest is divided by.
  const std::array<double, 4> squares{1 + x.x + y.y + z.z, 1 + x.x - y.y - z.z, 1 - x.x + y.y - z.z,
                                      1 - x.x - y.y + z.z};
  switch (std::ranges::max_element(squares) - squares.begin()) {
    case 0:
      return {squares[0], y.z - z.y, z.x - x.z, x.y - y.x};
    case 1:
      return {y.z - z.y, squares[1], x.y + y.x, z.x + x.z};
    case 2:
      return {z.x - x.z, x.y + y.x, squares[2], y.z + z.y};
    default:
      return {x.y - y.x, z.x + x.z, y.z + z.y, squares[3]};
  }
}

/// Three orthogonal unit vectors exactly, within rounding of the given ones: a quaternion of doubles is an exact
/// rotation.
std::array<RationalVec3, 3> exact_axes(const std::array<Vec3, 3>& axes) {
  const auto parts = quaternion_of(axes);
  const Rational a(parts[0]), b(parts[1]), c(parts[2]), d(parts[3]), two(2);
  const Rational scale = Rational(1) / (a * a + b * b + c * c + d * d);
  return {scale * RationalVec3(a * a + b * b - c * c - d * d, two * (b * c + a * d), two * (b * d - a * c)),
          scale * RationalVec3(two * (b * c - a * d), a * a - b * b + c * c - d * d, two * (c * d + a * b)),
          scale * RationalVec3(two * (b * d + a * c), two * (c * d - a * b), a * a - b * b - c * c + d * d)};
}

/// The least and the greatest height of points along an axis, exactly.
struct Extent {
  Rational low, high;
};
Extent extent_along(const RationalVec3& axis, const PointArray& points, double unit) {
  const Vec3 rounded{axis.x.nearest_double(), axis.y.nearest_double(), axis.z.nearest_double()};
  const Vec3 base = points[0].approx;
  std::vector<double> heights;
  double low = std::numeric_limits<double>::infinity(), high = -low, size = 0;
  for (const Vec3& p : points.approx()) {
    const Vec3 relative = p - base;
    heights.push_back(dot({relative.x / unit, relative.y / unit, relative.z / unit}, rounded));
    low = std::min(low, heights.back()), high = std::max(high, heights.back());
    size = std::max(size, detail::largest(relative) / unit);
  }
  // Some ten roundings of the size, and of the coordinates if these are rounded.
  const double off = 0x1p-48 * size + (points.exact_count() == 0 ? 0 : 0x1p-50 * (size + detail::largest(base) / unit));
  std::optional<Extent> extent;
  for (std::size_t i = 0; i < points.size(); ++i) {
    poll_interruption_at(i);
    if (heights[i] > low + off && heights[i] < high - off) continue;
    Rational height = dot(points[i].rational(), axis);
    if (!extent) extent = Extent{height, height};
    if (height < extent->low) extent->low = height;
    if (extent->high < height) extent->high = std::move(height);
  }
  return *std::move(extent);
}

bool is_in_range(const RationalVec3& p) {
  return is_finite({p.x.nearest_double(), p.y.nearest_double(), p.z.nearest_double()});
}

Maybe<OrientedBox> box_along(const std::array<Vec3, 3>& rounded_axes, const PointArray& points, double unit) {
  const std::array<RationalVec3, 3> axes = exact_axes(rounded_axes);
  OrientedBox box;
  std::array<Extent, 3> extents;
  for (std::size_t i = 0; i < 3; ++i) {
    extents[i] = extent_along(axes[i], points, unit);
    box.sizes[i] = extents[i].high - extents[i].low;
  }
  std::ranges::sort(box.sizes, std::greater());
  PointArray corners;
  for (unsigned corner = 0; corner < 8; ++corner) {
    RationalVec3 p;
    for (std::size_t i = 0; i < 3; ++i) p = p + ((corner >> i & 1U) != 0 ? extents[i].high : extents[i].low) * axes[i];
    if (!is_in_range(p)) return Undefined{"a corner of the box is beyond the range of doubles"};
    corners.push_back(ExactPoint(p));
  }
  box.mesh = TriangleMesh(std::move(corners), kBoxTriangles);
  return box;
}

}  // namespace

Result<Maybe<OrientedBox>> minimal_box(const TriangleMesh& hull, const Monitor& monitor) {
  const HullOutline outline(hull);
  const BoxVolume volume_of(outline);
  detail::FoundDirection best;
  for (const Vec3& normal : outline.normals())
    if (const double value = volume_of(normal, 0).value; value < best.value) best = {normal, value, 0};
  // One of the three axes of any box is within this angle of any direction, but for its sign.
  const double angle = std::acos(1 / std::numbers::sqrt3) + 0x1p-20;
  detail::DirectionSearch search(
      {.middle = outline.main_axis(), .angle = angle, .ratio = 1.05 - 0x1p-20, .budget = 5000});
  A3D_ASSIGN(best, search.run(best, volume_of, monitor));
  best = polished(best, volume_of);

  const HullOutline::View view = outline.seen_along(best.direction);
  const auto [x, y] = smallest_rectangle(view.outline).direction;
  const Vec3 side = x * view.x_axis + y * view.y_axis;
  Maybe<OrientedBox> box =
      box_along({best.direction, side, cross(best.direction, side)}, hull.points(), outline.unit());
  if (!box) return box;
  const Rational unit(outline.unit());
  const Rational volume = (*box).sizes[0] * (*box).sizes[1] * (*box).sizes[2] / (unit * unit * unit);
  (*box).ratio = std::max(1.0, volume.upper_double() / best.lower_bound);
  return box;
}

}  // namespace algebra3d
