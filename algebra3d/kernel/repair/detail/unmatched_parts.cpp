#include "algebra3d/kernel/repair/detail/unmatched_parts.h"

#include <algorithm>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/repair/detail/triangle_parts.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using NearFaceId = StrongId<struct NearFaceTag>;

constexpr std::size_t kMostParts = 2000;

/// Faces of the solid that may meet unmatched triangles as given.
struct NearFaces {
  IdVector<NearFaceId, MeasuredTriangle> faces;
  IdVector<NearFaceId, bool> is_unmatched;
  rtree::RTree<std::uint32_t> tree;

  NearFaces(const MeasureFrame& frame, const TriangleMatching& matching);
};

NearFaces::NearFaces(const MeasureFrame& frame, const TriangleMatching& matching) {
  if (matching.given.triangles.empty()) return;
  std::vector<Triangle3> unmatched;
  unmatched.reserve(matching.solid.triangles.size());
  for (const MeasuredTriangle& triangle : matching.solid.triangles) unmatched.push_back(key_of(triangle.corners));
  std::ranges::sort(unmatched);
  std::vector<rtree::Entry<std::uint32_t>> entries;
  for (const FaceId face : algebra3d::faces(frame.solid())) {
    const Triangle3 corners = frame.of_solid(face);
    if (!matching.given.tree.window(box_of(corners)).next()) continue;
    entries.push_back({box_of(corners), faces.next_id().index()});
    faces.push_back(MeasuredTriangle(corners));
    is_unmatched.push_back(std::ranges::binary_search(unmatched, key_of(corners)));
  }
  tree = rtree::RTree<std::uint32_t>::bulk_load(entries);
}

class GivenCutter {
 public:
  GivenCutter(MeasureFrame& frame, const TriangleMatching& matching)
      : frame_(frame), given_(matching.given), near_(frame, matching) {
    result_.area_seen = matching.matched_area;
  }

  Result<GivenParts> run();

 private:
  Status cut(UnmatchedId i);
  void subtract_earlier(UnmatchedId i, TriangleParts& parts);
  Result<std::vector<NearFaceId>> subtract_solid(UnmatchedId i, TriangleParts& parts);

  MeasureFrame& frame_;
  const UnmatchedTriangles& given_;
  NearFaces near_;
  GivenParts result_;
};

/// Subtracts coplanar triangles as given that come before.
void GivenCutter::subtract_earlier(UnmatchedId i, TriangleParts& parts) {
  const double tolerance = frame_.tolerance();
  const MeasuredTriangle& triangle = given_.triangles[i];
  for (const std::uint32_t number : given_.near(i, given_.tree, 0)) {
    const UnmatchedId other(number);
    if (other >= i || parts.is_empty() || parts.size() > kMostParts) break;
    if (!are_coplanar(triangle, given_.triangles[other], tolerance)) continue;
    if (parts.subtract(given_.triangles[other], tolerance) > tolerance * tolerance)
      result_.lies_upon.emplace_back(i, other);
  }
}

/// Subtracts coplanar faces of the solid; gives the near faces that are not coplanar.
Result<std::vector<NearFaceId>> GivenCutter::subtract_solid(UnmatchedId i, TriangleParts& parts) {
  const double tolerance = frame_.tolerance();
  const MeasuredTriangle& triangle = given_.triangles[i];
  std::vector<NearFaceId> crossing;
  for (const std::uint32_t number : given_.near(i, near_.tree, tolerance)) {
    A3D_TRY(frame_.pause());
    const NearFaceId face(number);
    if (!are_coplanar(triangle, near_.faces[face], tolerance)) {
      crossing.push_back(face);
      continue;
    }
    const double covered = parts.subtract(near_.faces[face], tolerance);
    // The area of a matched triangle has been counted before.
    if (!near_.is_unmatched[face])
      result_.area_seen -= covered;
    else if (covered > tolerance * tolerance)
      result_.are_covered[i] = true;
  }
  return crossing;
}

Status GivenCutter::cut(UnmatchedId i) {
  A3D_TRY(frame_.pause());
  TriangleParts parts(given_.triangles[i]);
  subtract_earlier(i, parts);
  result_.area_seen += parts.area();
  if (parts.is_empty()) return {};
  A3D_ASSIGN(const std::vector<NearFaceId> crossing, subtract_solid(i, parts));
  for (const NearFaceId face : crossing) {
    if (parts.is_empty()) break;
    A3D_TRY(frame_.pause());
    parts.divide_at(near_.faces[face], frame_.tolerance(), kMostParts);
  }
  for (ConvexPolygon& part : std::move(parts).polygons())
    if (frame_.counts(part)) result_.parts.push_back({i, std::move(part)});
  return {};
}

Result<GivenParts> GivenCutter::run() {
  result_.are_covered.assign(given_.triangles.size(), false);
  for (const UnmatchedId i : given_.triangles.ids()) A3D_TRY(cut(i));
  return std::move(result_);
}

}  // namespace

Result<GivenParts> parts_of_given(MeasureFrame& frame, const TriangleMatching& matching) {
  return GivenCutter(frame, matching).run();
}

Result<std::vector<SurfacePart>> parts_of_solid(MeasureFrame& frame, const TriangleMatching& matching) {
  const double tolerance = frame.tolerance();
  std::vector<SurfacePart> result;
  for (const UnmatchedId i : matching.solid.triangles.ids()) {
    A3D_TRY(frame.pause());
    const MeasuredTriangle& triangle = matching.solid.triangles[i];
    TriangleParts parts(triangle);
    for (const std::uint32_t number : matching.solid.near(i, matching.given.tree, 0)) {
      if (parts.is_empty()) break;
      const MeasuredTriangle& other = matching.given.triangles[UnmatchedId(number)];
      if (are_coplanar(triangle, other, tolerance)) parts.subtract(other, tolerance);
    }
    for (ConvexPolygon& part : std::move(parts).polygons())
      if (frame.counts(part)) result.push_back({i, std::move(part)});
  }
  return result;
}

}  // namespace algebra3d
