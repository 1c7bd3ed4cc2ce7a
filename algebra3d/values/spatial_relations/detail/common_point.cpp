#include "algebra3d/values/spatial_relations/detail/common_point.h"

#include <cassert>
#include <optional>

#include "algebra3d/kernel/exact/intersection_point.h"

namespace algebra3d {
namespace {

std::optional<ExactPoint> common_corner(const TriangleRef& of, const TriangleRef& with) {
  for (const PointRef& corner : of)
    if (is_on_triangle(corner, with)) return ExactPoint(corner);
  return std::nullopt;
}

/// Where an edge of one triangle passes through the other, which lies in another plane.
std::optional<ExactPoint> crossing_of_edge(const TriangleRef& of, const TriangleRef& with) {
  for (std::size_t i = 0; i < 3; ++i) {
    const PointRef &p = of[i], &q = of[(i + 1) % 3];
    if (intersect_segment_triangle(p, q, with) == Contact::point)
      return intersect_line_plane(p, q, IntegerPlane::through(with));
  }
  return std::nullopt;
}

std::size_t axis_of(Projection plane) {
  return 3 - first_axis(plane) - second_axis(plane);
}

/// Where two edges cross of which no one ends in the other triangle.
std::optional<ExactPoint> crossing_of_coplanar_edges(const TriangleRef& s, const TriangleRef& t) {
  const std::size_t axis = axis_of(dominant_projection(s[0], s[1], s[2]));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const PointRef &p = s[i], &q = s[(i + 1) % 3], &u = t[j], &v = t[(j + 1) % 3];
      if (intersect_segments(p, q, u, v) == Contact::point)
        return intersect_line_plane(p, q, IntegerPlane::along_axis(u, v, axis));
    }
  return std::nullopt;
}

}  // namespace

ExactPoint common_point(const TriangleRef& s, const TriangleRef& t, const SidedContact& contact) {
  std::optional<ExactPoint> point = common_corner(s, t);
  if (!point) point = common_corner(t, s);
  if (!point && contact.is_coplanar()) point = crossing_of_coplanar_edges(s, t);
  if (!point) point = crossing_of_edge(s, t);
  if (!point) point = crossing_of_edge(t, s);
  assert(point);
  return *point;
}

}  // namespace algebra3d
