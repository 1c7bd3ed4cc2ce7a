#include "algebra3d/kernel/repair/detail/unmatched_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "algebra3d/kernel/halfedge/circulators.h"

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

/// The keys of the triangles as given that are not known to be matched, sorted. The area of the others is added up.
std::vector<Triangle3> keys_of_given(const MeasureFrame& frame, const FaceMatches& recognised, double& matched_area) {
  IdVector<FaceId, bool> is_known(frame.given().face_count());
  for (const FaceId face : recognised)
    if (face.is_valid()) is_known[face] = true;
  std::vector<Triangle3> keys;
  for (const FaceId face : faces(frame.given())) {
    const Triangle3 corners = frame.of_given(face);
    const double area = area_of(corners);
    if (is_known[face]) matched_area += area;
    if (!is_known[face] && area > 0) keys.push_back(key_of(corners));
  }
  std::ranges::sort(keys);
  return keys;
}

/// Adds the solid's triangles that have no key to its unmatched ones. Flags the first of equal keys that are matched.
std::vector<bool> match_solid(const MeasureFrame& frame, const FaceMatches& recognised,
                              const std::vector<Triangle3>& keys, UnmatchedTriangles& unmatched) {
  std::vector<bool> is_matched(keys.size());
  for (const FaceId face : faces(frame.solid())) {
    const bool is_known = face.index() < recognised.size() && recognised[face].is_valid();
    if (is_known) continue;
    const Triangle3 corners = frame.of_solid(face);
    const auto place = std::ranges::lower_bound(keys, key_of(corners));
    if (place != keys.end() && *place == key_of(corners))
      is_matched[static_cast<std::size_t>(place - keys.begin())] = true;
    else if (area_of(corners) > 0)
      unmatched.add(corners, 1);
  }
  return is_matched;
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

void UnmatchedTriangles::add(const Triangle3& corners, std::uint64_t count) {
  triangles.push_back(MeasuredTriangle(corners));
  copies.push_back(count);
}

void UnmatchedTriangles::index(double tolerance) {
  std::vector<rtree::Entry<std::uint32_t>> entries;
  entries.reserve(triangles.size());
  for (const UnmatchedId i : triangles.ids()) entries.push_back({box(i, tolerance), i.index()});
  tree = rtree::RTree<std::uint32_t>::bulk_load(entries);
}

Box3 UnmatchedTriangles::box(UnmatchedId i, double wider) const {
  Box3 result = box_of(triangles[i].corners);
  result.min = result.min - Vec3{wider, wider, wider};
  result.max = result.max + Vec3{wider, wider, wider};
  return result;
}

std::vector<std::uint32_t> UnmatchedTriangles::near(UnmatchedId i, const rtree::RTree<std::uint32_t>& others,
                                                    double wider) const {
  std::vector<std::uint32_t> result;
  for (const std::uint32_t other : others.window(box(i, wider))) result.push_back(other);
  std::ranges::sort(result);
  return result;
}

Triangle3 key_of(Triangle3 corners) {
  std::ranges::sort(corners);
  return corners;
}

TriangleMatching match_triangles(const MeasureFrame& frame, const FaceMatches& recognised) {
  TriangleMatching result;
  const std::vector<Triangle3> keys = keys_of_given(frame, recognised, result.matched_area);
  const std::vector<bool> is_matched = match_solid(frame, recognised, keys, result.solid);
  for (std::size_t first = 0, last = 0; first < keys.size(); first = last) {
    while (last < keys.size() && keys[last] == keys[first]) ++last;
    if (is_matched[first])
      result.matched_area += area_of(keys[first]);
    else
      result.given.add(keys[first], last - first);
  }
  result.given.index(frame.tolerance());
  result.solid.index(frame.tolerance());
  return result;
}

}  // namespace algebra3d
