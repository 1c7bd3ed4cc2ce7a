#include "algebra3d/kernel/repair/detail/triangle_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
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
  std::array<Vec3, 6> ends;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    if (heights[i] == 0) ends[count++] = triangle[i];
    if ((heights[i] < 0 && heights[next] > 0) || (heights[i] > 0 && heights[next] < 0))
      ends[count++] = triangle[i] + (heights[i] / (heights[i] - heights[next])) * (triangle[next] - triangle[i]);
  }
  if (count != 2) return std::nullopt;
  return std::pair(ends[0], ends[1]);
}

/// A box, wider by a margin.
Box3 with_margin(Box3 box, double margin) {
  box.min = box.min - Vec3{margin, margin, margin};
  box.max = box.max + Vec3{margin, margin, margin};
  return box;
}

}  // namespace

bool are_coplanar(const MeasuredTriangle& a, const MeasuredTriangle& b, double tolerance) {
  return lies_near_plane(b.corners, a.plane, tolerance) || lies_near_plane(a.corners, b.plane, tolerance);
}

TriangleParts::Part::Part(ConvexPolygon whole)
    : polygon(std::move(whole)), box(Box3::around(polygon.corners)), area(polygon.area()) {}

TriangleParts::TriangleParts(const MeasuredTriangle& triangle) : triangle_(triangle) {
  parts_.emplace_back(ConvexPolygon{{triangle.corners.begin(), triangle.corners.end()}});
}

double TriangleParts::area() const {
  double sum = 0;
  for (const Part& part : parts_) sum += part.area;
  return sum;
}

/// None if a side has no length.
std::optional<TriangleParts::Sides> TriangleParts::sides_of(const MeasuredTriangle& cutter) const {
  Sides sides;
  const double way = dot(triangle_.plane.normal, cutter.plane.normal) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &from = cutter.corners[i], &to = cutter.corners[(i + 1) % 3];
    const Vec3 outward = cross(to - from, way * triangle_.plane.normal);
    const double size = length(outward);
    if (!(size > 0)) return std::nullopt;
    sides[i] = {from, (1 / size) * outward};
  }
  return sides;
}

/// The parts of a polygon that do not lie upon the cutter; none if nothing of it does.
std::optional<std::vector<ConvexPolygon>> TriangleParts::rest_of(const ConvexPolygon& polygon, const Sides& sides,
                                                                 double tolerance) {
  std::vector<ConvexPolygon> rest;
  ConvexPolygon cut;
  const ConvexPolygon* common = &polygon;
  for (const OrientedPlane& side : sides) {
    const auto is_behind = [&](const Vec3& corner) { return side.height(corner) <= tolerance; };
    const auto is_before = [&](const Vec3& corner) { return side.height(corner) >= -tolerance; };
    if (std::ranges::all_of(common->corners, is_behind)) continue;
    if (std::ranges::all_of(common->corners, is_before)) return std::nullopt;
    PlaneSplit parts = split(*common, side, tolerance);
    rest.push_back(std::move(parts.before));
    cut = std::move(parts.behind);
    common = &cut;
  }
  return rest;
}

double TriangleParts::subtract(const MeasuredTriangle& cutter, double tolerance) {
  const Box3 reach = with_margin(box_of(cutter.corners), tolerance);
  const auto is_reached = [&](const Part& part) { return part.box.intersects(reach); };
  if (std::ranges::none_of(parts_, is_reached)) return 0;
  const std::optional<Sides> sides = sides_of(cutter);
  if (!sides) return 0;
  const double before = area();
  std::vector<Part> left;
  left.reserve(parts_.size() + 2);
  for (Part& part : parts_) {
    auto rest = is_reached(part) ? rest_of(part.polygon, *sides, tolerance) : std::nullopt;
    if (!rest) left.push_back(std::move(part));
    if (rest)
      for (ConvexPolygon& polygon : *rest) left.emplace_back(std::move(polygon));
  }
  parts_ = std::move(left);
  return before - area();
}

void TriangleParts::divide_at(const MeasuredTriangle& other, double tolerance, std::size_t most) {
  const auto line = line_in_plane(other.corners, triangle_.plane, tolerance);
  if (!line) return;
  const auto& [from, to] = *line;
  const Vec3 across = cross(triangle_.plane.normal, to - from);
  const double size = length(across);
  if (!(size > tolerance)) return;
  const OrientedPlane divider{from, (1 / size) * across};
  const Box3 reach = with_margin(unite(Box3::of(from), Box3::of(to)), tolerance);
  const std::size_t count = parts_.size();
  for (std::size_t i = 0; i < count && parts_.size() < most; ++i) {
    if (!parts_[i].box.intersects(reach)) continue;
    if (!(length_within(parts_[i].polygon, triangle_.plane.normal, from, to) > tolerance)) continue;
    PlaneSplit halves = split(parts_[i].polygon, divider, tolerance);
    if (halves.behind.is_empty() || halves.before.is_empty()) continue;
    parts_[i] = Part(std::move(halves.behind));
    parts_.emplace_back(std::move(halves.before));
  }
}

std::vector<ConvexPolygon> TriangleParts::polygons() && {
  std::vector<ConvexPolygon> result;
  result.reserve(parts_.size());
  for (Part& part : parts_) result.push_back(std::move(part.polygon));
  return result;
}

}  // namespace algebra3d
