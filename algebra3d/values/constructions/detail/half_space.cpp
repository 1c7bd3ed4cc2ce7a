#include "algebra3d/values/constructions/detail/half_space.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/box_corners.h"

namespace algebra3d {
namespace {

std::size_t dominant_axis(const RationalVec3& normal) {
  std::size_t axis = normal.y.abs() > normal.x.abs() ? 1 : 0;
  if (normal.z.abs() > normal[axis].abs()) axis = 2;
  return axis;
}

/// A power of two above the magnitude of all coordinates.
double bound_of(const Box3& box) {
  double size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    size = std::max({size, std::abs(box.min[axis]), std::abs(box.max[axis])});
  return std::max(std::exp2(std::ilogb(size) + 1), 0x1p-1000);
}

RationalVec3 with_axes(std::size_t axis, const Rational& along, const Rational& next, const Rational& after) {
  std::array<Rational, 3> coordinates;
  coordinates[axis] = along;
  coordinates[(axis + 1) % 3] = next;
  coordinates[(axis + 2) % 3] = after;
  return {coordinates[0], coordinates[1], coordinates[2]};
}

}  // namespace

int side_of(const Box3& box, const ExactPlane& plane) {
  bool is_in_front = false, is_behind = false;
  for (unsigned i = 0; i < 8; ++i) {
    const int sign = plane.evaluate(RationalVec3(corner_of(box, i))).sign();
    is_in_front = is_in_front || sign > 0;
    is_behind = is_behind || sign < 0;
  }
  return is_in_front && is_behind ? 0 : is_behind ? -1 : 1;
}

TriangleMesh half_space_within(const Box3& box, const ExactPlane& plane) {
  const std::size_t axis = dominant_axis(plane.normal), next = (axis + 1) % 3, after = (axis + 2) % 3;
  const double size = bound_of(box);
  // The plane passes the box and rises by at most 1 along the other axes, so over the square of twice the bound it
  // stays within five times the bound.
  const double floor = 8 * size;
  const bool is_behind_below = plane.normal[axis].sign() > 0;
  PointArray points;
  for (unsigned i = 0; i < 8; ++i) {
    // The prism has the corners of a box; those with bit 0 are in the plane.
    const Rational u((i & 2U) != 0 ? size : -size), v((i & 4U) != 0 ? size : -size);
    const Rational in_plane = (plane.offset - plane.normal[next] * u - plane.normal[after] * v) / plane.normal[axis];
    const Rational beyond(is_behind_below ? -floor : floor);
    points.push_back(ExactPoint(with_axes(axis, (i & 1U) != 0 ? in_plane : beyond, u, v)));
  }
  std::vector<TriangleMesh::Triangle> triangles(kBoxTriangles.begin(), kBoxTriangles.end());
  if (!is_behind_below)
    for (auto& [a, b, c] : triangles) std::swap(b, c);
  return {std::move(points), triangles};
}

TriangleMesh solid_of(const Box3& box) {
  std::vector<Vec3> points;
  for (unsigned i = 0; i < 8; ++i) points.push_back(corner_of(box, i));
  return {PointArray(std::move(points)), kBoxTriangles};
}

}  // namespace algebra3d
