#include "algebra3d/kernel/exact/triangle_box.h"

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>

namespace algebra3d {
namespace {

std::array<Vec3, 8> corners_of(const Box3& box) {
  std::array<Vec3, 8> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners[i] = {(i & 1U) != 0 ? box.max.x : box.min.x, (i & 2U) != 0 ? box.max.y : box.min.y,
                  (i & 4U) != 0 ? box.max.z : box.min.z};
  return corners;
}

/// True if a plane between the triangle and the box is perpendicular to an axis.
bool are_apart_along_axis(const TriangleRef& triangle, const Box3& box, std::size_t axis) {
  return std::ranges::all_of(triangle, [&](const PointRef& p) { return compare(axis, p, box.max) > 0; }) ||
         std::ranges::all_of(triangle, [&](const PointRef& p) { return compare(axis, p, box.min) < 0; });
}

/// True if the box is strictly on one side of the triangle's plane.
bool is_off_plane(const TriangleRef& triangle, const std::array<Vec3, 8>& corners) {
  const auto side = [&](const Vec3& corner) { return orient3d(triangle[0], triangle[1], triangle[2], corner); };
  const int first = side(corners[0]);
  return first != 0 && std::all_of(corners.begin() + 1, corners.end(), [&](const Vec3& p) { return side(p) == first; });
}

/// True if in a projection the line of an edge has the box strictly on one side, and the triangle not there.
bool are_apart_along_edge(const TriangleRef& triangle, const std::array<Vec3, 8>& corners, Projection projection,
                          std::size_t edge) {
  const PointRef &p = triangle[edge], &q = triangle[(edge + 1) % 3], &r = triangle[(edge + 2) % 3];
  const auto side = [&](const PointRef& point) { return orient2d(projection, p, q, point); };
  const int first = side(corners[0]);
  return first != 0 && side(r) != first &&
         std::all_of(corners.begin() + 1, corners.end(), [&](const Vec3& corner) { return side(corner) == first; });
}

}  // namespace

bool meets_box(const TriangleRef& triangle, const Box3& box) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (are_apart_along_axis(triangle, box, axis)) return false;
  const std::array<Vec3, 8> corners = corners_of(box);
  if (is_off_plane(triangle, corners)) return false;
  for (const Projection projection : {Projection::xy, Projection::yz, Projection::zx})
    for (std::size_t edge = 0; edge < 3; ++edge)
      if (are_apart_along_edge(triangle, corners, projection, edge)) return false;
  return true;
}

}  // namespace algebra3d
