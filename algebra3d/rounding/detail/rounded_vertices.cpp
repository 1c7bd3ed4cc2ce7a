#include "algebra3d/rounding/detail/rounded_vertices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra3d/base/box3.h"

namespace algebra3d {
namespace {

/// An upper bound of the distance between a point and the doubles to which it is rounded: the double nearest to an
/// exact coordinate is at most half a spacing away from it.
double distance_to_rounded(const PointRef& point, const Vec3& rounded) {
  Vec3 difference;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double size = std::abs(point.approx[axis]);
    const double half_spacing = point.is_double() ? 0 : (std::nextafter(size, Box3::kInfinity) - size) / 2;
    difference[axis] = std::abs(point.approx[axis] - rounded[axis]) + half_spacing;
  }
  // Five roundings, some of which may come down to nothing.
  const double length = std::hypot(difference.x, difference.y, difference.z);
  return length * (1 + 8 * std::numeric_limits<double>::epsilon()) + std::numeric_limits<double>::denorm_min();
}

Vec3 nearest(const CoordinateGrid& grid, const Vec3& point) {
  return {grid.nearest(point.x), grid.nearest(point.y), grid.nearest(point.z)};
}

}  // namespace

std::vector<bool> are_moved(const TriangleMesh& mesh, const CoordinateGrid& grid) {
  std::vector<bool> result;
  result.reserve(mesh.vertex_count());
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    const PointRef given = mesh.points()[i];
    result.push_back(!given.is_double() || given.approx != nearest(grid, given.approx));
  }
  return result;
}

RoundedVertices rounded_vertices(const TriangleMesh& mesh, const CoordinateGrid& grid) {
  RoundedVertices result;
  std::vector<Vec3> rounded;
  rounded.reserve(mesh.vertex_count());
  result.movements.reserve(mesh.vertex_count());
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    const PointRef given = mesh.points()[i];
    const Vec3 point = nearest(grid, given.approx);
    result.are_finite = result.are_finite && is_finite(point);
    if (!result.are_finite) return result;
    const bool is_moved = !given.is_double() || given.approx != point;
    const double movement = is_moved ? distance_to_rounded(given, point) : 0;
    if (is_moved) ++result.moved;
    result.largest_movement = std::max(result.largest_movement, movement);
    result.movements.push_back(movement);
    rounded.push_back(point);
  }
  result.points = PointArray(std::move(rounded));
  return result;
}

double rounded_up(double length) {
  return length * (1 + 0x1p-40);
}

}  // namespace algebra3d
