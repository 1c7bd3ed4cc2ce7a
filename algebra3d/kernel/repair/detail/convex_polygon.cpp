#include "algebra3d/kernel/repair/detail/convex_polygon.h"

#include <algorithm>
#include <cmath>

namespace algebra3d {
namespace {

double distance_to_segment(const Vec3& p, const Vec3& from, const Vec3& to) {
  const Vec3 along = to - from;
  const double whole = dot(along, along);
  const double at = whole > 0 ? std::clamp(dot(p - from, along) / whole, 0.0, 1.0) : 0.0;
  return length(p - (from + at * along));
}

Vec3 unit(const Vec3& v) {
  const double size = length(v);
  return size > 0 ? (1 / size) * v : Vec3{};
}

}  // namespace

double ConvexPolygon::area() const {
  Vec3 sum;
  for (std::size_t i = 2; i < corners.size(); ++i)
    sum = sum + cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return length(sum) / 2;
}

Vec3 ConvexPolygon::middle() const {
  Vec3 sum;
  for (const Vec3& corner : corners) sum = sum + (1 / static_cast<double>(corners.size())) * corner;
  return sum;
}

std::vector<Triangle3> ConvexPolygon::triangles() const {
  std::vector<Triangle3> result;
  for (std::size_t i = 2; i < corners.size(); ++i) result.push_back({corners[0], corners[i - 1], corners[i]});
  return result;
}

PlaneSplit split(const ConvexPolygon& polygon, const OrientedPlane& plane, double noise) {
  std::vector<double> heights;
  for (const Vec3& corner : polygon.corners) heights.push_back(plane.height(corner));
  if (std::ranges::all_of(heights, [&](double h) { return h <= noise; })) return {polygon, {}};
  if (std::ranges::all_of(heights, [&](double h) { return h >= -noise; })) return {{}, polygon};
  PlaneSplit parts;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const std::size_t next = i + 1 == heights.size() ? 0 : i + 1;
    const Vec3 &from = polygon.corners[i], &to = polygon.corners[next];
    if (heights[i] <= 0) parts.behind.corners.push_back(from);
    if (heights[i] >= 0) parts.before.corners.push_back(from);
    if (!(heights[i] < 0 && heights[next] > 0) && !(heights[i] > 0 && heights[next] < 0)) continue;
    const Vec3 crossing = from + (heights[i] / (heights[i] - heights[next])) * (to - from);
    parts.behind.corners.push_back(crossing);
    parts.before.corners.push_back(crossing);
  }
  return parts;
}

double length_within(const ConvexPolygon& polygon, const Vec3& normal, Vec3 from, Vec3 to) {
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    const Vec3& corner = polygon.corners[i];
    const Vec3& next = polygon.corners[i + 1 == polygon.corners.size() ? 0 : i + 1];
    const Vec3 inward = cross(normal, next - corner);
    const double first = dot(from - corner, inward), last = dot(to - corner, inward);
    if (first < 0 && last < 0) return 0;
    if (first < 0) from = from + (first / (first - last)) * (to - from);
    if (last < 0) to = from + (first / (first - last)) * (to - from);
  }
  return length(to - from);
}

double area_of(const Triangle3& triangle) {
  return length(cross(triangle[1] - triangle[0], triangle[2] - triangle[0])) / 2;
}

Vec3 unit_normal(const Triangle3& triangle) {
  // Sides are made of length 1 first, so that products neither overflow nor vanish.
  return unit(cross(unit(triangle[1] - triangle[0]), unit(triangle[2] - triangle[0])));
}

Box3 box_of(const Triangle3& triangle) {
  Box3 box;
  for (const Vec3& corner : triangle) box.extend(corner);
  return box;
}

double distance(const Vec3& point, const Triangle3& triangle) {
  const auto& [a, b, c] = triangle;
  const Vec3 normal = unit_normal(triangle);
  const auto is_left = [&](const Vec3& from, const Vec3& to) {
    return dot(cross(normal, to - from), point - from) >= 0;
  };
  const bool is_above = dot(normal, normal) > 0 && is_left(a, b) && is_left(b, c) && is_left(c, a);
  if (is_above) return std::abs(dot(point - a, normal));
  return std::min(
      {distance_to_segment(point, a, b), distance_to_segment(point, b, c), distance_to_segment(point, c, a)});
}

}  // namespace algebra3d
