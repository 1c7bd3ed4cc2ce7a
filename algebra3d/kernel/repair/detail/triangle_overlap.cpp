#include "algebra3d/kernel/repair/detail/triangle_overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace algebra3d {
namespace {

bool lies_near_plane(const Triangle3& corners, const OrientedPlane& plane, double tolerance) {
  return std::ranges::all_of(corners, [&](const Vec3& p) { return std::abs(plane.height(p)) <= tolerance; });
}

/// The segment in which a triangle meets a plane; none if it is not one segment. Corners nearer than the tolerance lie
/// in the plane.
std::optional<std::pair<Vec3, Vec3>> line_in_plane(const Triangle3& triangle, const OrientedPlane& plane,
                                                   double tolerance) {
  std::array<double, 3> heights{};
  for (std::size_t i = 0; i < 3; ++i) {
    heights[i] = plane.height(triangle[i]);
    if (std::abs(heights[i]) <= tolerance) heights[i] = 0;
  }
  std::vector<Vec3> ends;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    if (heights[i] == 0) ends.push_back(triangle[i]);
    if ((heights[i] < 0 && heights[next] > 0) || (heights[i] > 0 && heights[next] < 0))
      ends.push_back(triangle[i] + (heights[i] / (heights[i] - heights[next])) * (triangle[next] - triangle[i]));
  }
  if (ends.size() != 2) return std::nullopt;
  return std::pair(ends[0], ends[1]);
}

/// The parts of a polygon that do not lie upon the cutter; the polygon itself if nothing of it does.
std::vector<ConvexPolygon> rest_of(const ConvexPolygon& polygon, const MeasuredTriangle& triangle,
                                   const MeasuredTriangle& cutter, double tolerance) {
  std::vector<ConvexPolygon> rest;
  ConvexPolygon common = polygon;
  const double way = dot(triangle.plane.normal, cutter.plane.normal) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &from = cutter.corners[i], &to = cutter.corners[(i + 1) % 3];
    const Vec3 outward = cross(to - from, way * triangle.plane.normal);
    const double size = length(outward);
    if (!(size > 0)) return {polygon};
    PlaneSplit parts = split(common, {from, (1 / size) * outward}, tolerance);
    if (parts.behind.is_empty()) return {polygon};
    if (!parts.before.is_empty()) rest.push_back(std::move(parts.before));
    common = std::move(parts.behind);
  }
  return rest;
}

}  // namespace

bool are_coplanar(const MeasuredTriangle& a, const MeasuredTriangle& b, double tolerance) {
  return lies_near_plane(b.corners, a.plane, tolerance) || lies_near_plane(a.corners, b.plane, tolerance);
}

void subtract(std::vector<ConvexPolygon>& parts, const MeasuredTriangle& triangle, const MeasuredTriangle& cutter,
              double tolerance) {
  std::vector<ConvexPolygon> rest;
  for (const ConvexPolygon& part : parts)
    for (ConvexPolygon& left : rest_of(part, triangle, cutter, tolerance)) rest.push_back(std::move(left));
  parts = std::move(rest);
}

void divide_at(std::vector<ConvexPolygon>& parts, const MeasuredTriangle& triangle, const MeasuredTriangle& other,
               double tolerance, std::size_t most) {
  const auto line = line_in_plane(other.corners, triangle.plane, tolerance);
  if (!line) return;
  const auto& [from, to] = *line;
  const Vec3 across = cross(triangle.plane.normal, to - from);
  const double size = length(across);
  if (!(size > tolerance)) return;
  const OrientedPlane divider{from, (1 / size) * across};
  const std::size_t count = parts.size();
  for (std::size_t i = 0; i < count && parts.size() < most; ++i) {
    if (!(length_within(parts[i], triangle.plane.normal, from, to) > tolerance)) continue;
    PlaneSplit halves = split(parts[i], divider, tolerance);
    if (halves.behind.is_empty() || halves.before.is_empty()) continue;
    parts[i] = std::move(halves.behind);
    parts.push_back(std::move(halves.before));
  }
}

}  // namespace algebra3d
