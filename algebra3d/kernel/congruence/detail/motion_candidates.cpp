#include "algebra3d/kernel/congruence/detail/motion_candidates.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>

#include "algebra3d/kernel/congruence/detail/point_grid.h"
#include "base/propagate.h"

namespace algebra3d::detail {
namespace {

/// Whether the moments i and i + 1 differ so much that rounding does not turn the axes noticeably.
bool are_distinct(const PrincipalAxes& axes, std::size_t i) {
  constexpr double kClear = 0x1p-10;
  return axes.values[i + 1] - axes.values[i] >= kClear * axes.values[2];
}

std::vector<Rotation> rotations_of_axes(const Frame& from, const Frame& to) {
  std::vector<Rotation> rotations;
  for (const double x : {1.0, -1.0})
    for (const double y : {1.0, -1.0})
      for (const double z : {1.0, -1.0})
        rotations.push_back(Rotation::between(from, {x * to[0], y * to[1], z * to[2]}));
  return rotations;
}

/// The height of a point along a line through the centre, and its distance from that line.
struct LinePlace {
  double height, distance;
};
LinePlace place_at(const Vec3& direction, const Vec3& p) {
  const double height = dot(p, direction);
  return {height, length(p - height * direction)};
}

template <typename Measure>
Vec3 farthest(const std::vector<Vec3>& points, const Measure& measure) {
  return *std::ranges::max_element(points, {}, measure);
}

/// A corner far from the line through the centre. It is where a strictly convex function is largest, so it is a corner
/// of the solid in every triangulation, not a vertex in the middle of an edge; and the function depends on the place
/// relative to the line only. Heights weigh so little that the corner is not on the line.
Vec3 corner_off_line(const CentredSolid& solid, const Vec3& direction) {
  const Vec3 far = farthest(solid.vertices(), [&](const Vec3& p) { return place_at(direction, p).distance; });
  const double ratio = place_at(direction, far).distance / solid.radius();
  return farthest(solid.vertices(), [&](const Vec3& p) {
    const auto [height, distance] = place_at(direction, p);
    return distance * distance + 0.5 * ratio * ratio * height * height;
  });
}

/// Matches one direction with others, and then a corner off its line.
class VertexMatcher {
 public:
  VertexMatcher(const CentredSolid& from, const CentredSolid& to, const Vec3& direction, double tolerance)
      : to_(to),
        direction_(direction),
        corner_(corner_off_line(from, direction)),
        place_(place_at(direction, corner_)),
        tolerance_(tolerance) {}

  void match(const Vec3& direction, std::vector<Rotation>& rotations) const {
    const Frame from = frame_of(direction_, corner_);
    for (const Vec3& q : to_.vertices()) {
      const auto [height, distance] = place_at(direction, q);
      if (!(std::abs(height - place_.height) <= tolerance_ && std::abs(distance - place_.distance) <= tolerance_))
        continue;
      if (!(distance > 0)) continue;
      const Frame target = frame_of(direction, q);
      rotations.push_back(Rotation::between(from, target));
      rotations.push_back(Rotation::between(from, {target[0], target[1], -1 * target[2]}));
    }
  }

 private:
  const CentredSolid& to_;
  Vec3 direction_, corner_;
  LinePlace place_;
  double tolerance_;
};

/// The number of the axis whose moment differs from the others; nothing if none does.
std::optional<std::size_t> distinct_axis(const PrincipalAxes& axes) {
  if (are_distinct(axes, 1)) return 2;
  return are_distinct(axes, 0) ? std::optional<std::size_t>(0) : std::nullopt;
}

/// The vertices about as far from the centre as the farthest.
std::vector<Vec3> far_vertices(const CentredSolid& solid, double tolerance) {
  std::vector<Vec3> far;
  std::ranges::copy_if(solid.vertices(), std::back_inserter(far),
                       [&](const Vec3& p) { return solid.radius() - length(p) <= tolerance; });
  return far;
}

constexpr std::size_t kManyFarVertices = 32;

/// Rotations that map p to one of the points, and q to another one at the same distance from it, with or without a
/// reflection. All are about equally far from the centre, which must not lie between p and q.
Result<std::vector<Rotation>> rotations_of_pairs(const Vec3& p, const Vec3& q, const std::vector<Vec3>& points,
                                                 double tolerance, const Monitor& monitor) {
  const double distance = length(q - p), reach = distance + 2 * tolerance;
  const Frame from = frame_of(p, q);
  PointGrid grid(points, reach);
  grid.insert_all();
  std::vector<Rotation> rotations;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % 1024 == 0) A3D_TRY(monitor.check());
    grid.for_each_near(points[i], reach, [&](std::uint32_t other) {
      if (std::abs(length(points[other] - points[i]) - distance) > 2 * tolerance) return true;
      const Frame to = frame_of(points[i], points[other]);
      rotations.push_back(Rotation::between(from, to));
      rotations.push_back(Rotation::between(from, {to[0], to[1], -1 * to[2]}));
      return true;
    });
  }
  return rotations;
}

Result<std::vector<Rotation>> rotations_of_vertices(const CentredSolid& from, const CentredSolid& to, double tolerance,
                                                    const Monitor& monitor) {
  std::vector<Rotation> rotations;
  if (const auto axis = distinct_axis(from.axes())) {
    const VertexMatcher matcher(from, to, from.axes().axes[*axis], tolerance);
    const Vec3 direction = to.axes().axes[*axis];
    matcher.match(direction, rotations);
    matcher.match(-1 * direction, rotations);
    return rotations;
  }
  const std::vector<Vec3> far = far_vertices(from, tolerance);
  if (far.size() > kManyFarVertices) {
    const ClosestPair closest = closest_pair(far);
    if (closest.distance > 16 * tolerance)
      return rotations_of_pairs(far[closest.first], far[closest.second], far_vertices(to, 2 * tolerance), tolerance,
                                monitor);
  }
  const VertexMatcher matcher(from, to, unit_vector(farthest(from.vertices(), length)), tolerance);
  for (const Vec3& q : to.vertices()) {
    if (!(std::abs(length(q) - from.radius()) <= tolerance)) continue;
    A3D_TRY(monitor.check());
    if (length(q) > 0) matcher.match(unit_vector(q), rotations);
  }
  return rotations;
}

}  // namespace

Result<std::vector<Rotation>> candidate_rotations(const CentredSolid& from, const CentredSolid& to, double tolerance,
                                                  const Monitor& monitor) {
  std::vector<Rotation> rotations;
  if (are_distinct(from.axes(), 0) && are_distinct(from.axes(), 1)) {
    rotations = rotations_of_axes(from.axes().axes, to.axes().axes);
  } else {
    // A vertex and the centre may each be off by the tolerance, on both sides.
    A3D_ASSIGN(rotations, rotations_of_vertices(from, to, 4 * tolerance, monitor));
  }
  std::ranges::stable_sort(rotations, [](const Rotation& a, const Rotation& b) {
    if (a.is_mirrored() != b.is_mirrored()) return b.is_mirrored();
    return a.is_mirrored() ? a.trace() < b.trace() : a.trace() > b.trace();
  });
  return rotations;
}

}  // namespace algebra3d::detail
