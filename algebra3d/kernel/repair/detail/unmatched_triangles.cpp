#include "algebra3d/kernel/repair/detail/unmatched_triangles.h"

#include <algorithm>

#include "algebra3d/kernel/halfedge/circulators.h"

namespace algebra3d {
namespace {

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
