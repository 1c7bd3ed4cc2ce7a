#include "algebra3d/kernel/convex/detail/first_simplex.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "base/interruption_scope.h"

namespace algebra3d::detail {
namespace {

/// The point with the largest value of measure(approximate point), not counting NaN.
template <typename Measure>
VertexId point_of_largest(const PointArray& points, const Measure& measure) {
  std::size_t best = 0;
  double largest = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    poll_interruption_at(i);
    const double value = measure(points.approx()[i]);
    if (!(value > largest)) continue;
    largest = value;
    best = i;
  }
  return VertexId(best);
}

/// `guess` if it is suitable, else the first point that is; invalid if none is.
template <typename IsSuitable>
VertexId confirmed(const PointArray& points, VertexId guess, const IsSuitable& is_suitable) {
  if (is_suitable(points[guess.index()])) return guess;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (is_suitable(points[i])) return VertexId(i);
  return {};
}

/// Two points far from each other, along the axis of the largest extent.
std::pair<VertexId, VertexId> far_points(const PointArray& points) {
  const Box3 box = Box3::around(points.approx());
  const Vec3 extent = box.max - box.min;
  const std::size_t axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  return {point_of_largest(points, [&](const Vec3& p) { return box.max[axis] - p[axis]; }),
          point_of_largest(points, [&](const Vec3& p) { return p[axis] - box.min[axis]; })};
}

}  // namespace

FirstSimplex first_simplex(const PointArray& points) {
  FirstSimplex simplex;
  if (points.size() == 0) return simplex;
  const auto add = [&](VertexId corner) {
    if (!corner.is_valid()) return false;
    simplex.corners[static_cast<std::size_t>(++simplex.dimension)] = corner;
    return true;
  };
  const auto corner = [&](std::size_t i) { return points[simplex.corners[i].index()]; };

  const auto [low, high] = far_points(points);
  add(low);
  if (!add(confirmed(points, high, [&](PointRef p) { return !equal(corner(0), p); }))) return simplex;

  const Vec3 a = corner(0).approx, u = corner(1).approx - a;
  const VertexId off_line = point_of_largest(points, [&](const Vec3& p) {
    const Vec3 normal = cross(u, p - a);
    return dot(normal, normal);
  });
  if (!add(confirmed(points, off_line, [&](PointRef p) { return !collinear(corner(0), corner(1), p); })))
    return simplex;

  const Vec3 normal = cross(u, corner(2).approx - a);
  const VertexId off_plane = point_of_largest(points, [&](const Vec3& p) { return std::abs(dot(normal, p - a)); });
  add(confirmed(points, off_plane, [&](PointRef p) { return orient3d(corner(0), corner(1), corner(2), p) != 0; }));
  return simplex;
}

}  // namespace algebra3d::detail
