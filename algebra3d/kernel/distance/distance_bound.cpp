#include "algebra3d/kernel/distance/distance_bound.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra3d/kernel/distance/detail/face_bounds.h"
#include "algebra3d/kernel/search/boxes.h"
#include "base/propagate.h"

namespace algebra3d {

Result<double> bounded_distance(const TriangleMesh& from, std::span<const BoundedFace> faces, const DistanceOperand& to,
                                double enough, const Monitor& monitor) {
  std::vector<BoundedFace> by_bound(faces.begin(), faces.end());
  std::ranges::stable_sort(by_bound, std::ranges::greater(), &BoundedFace::at_most);
  const Box3 box = unite(Box3::around(from.points().approx()), to.hierarchy->bounds());
  const distances::LargeFacets no_facets;  // faces are few
  for (const BoundedFace& face : by_bound) {
    if (face.at_most <= enough) break;
    distances::FaceBounds<WideVec3> bounds(from, to, no_facets, box, enough, monitor);
    const double upper = bounds.of(face.face, {face.near, face.near, face.near}).upper;
    A3D_TRY(monitor.check());
    enough = std::max(enough, std::min(upper, face.at_most));
  }
  return enough;
}

Result<double> bounded_distance(const TriangleMesh& from, double at_most, const DistanceOperand& to, double enough,
                                const Monitor& monitor) {
  if (at_most <= enough) return at_most;
  std::vector<BoundedFace> faces;
  faces.reserve(from.face_count());
  for (std::size_t f = 0; f < from.face_count(); ++f) {
    const Vec3 corner = from.corners(FaceId(f))[0].approx, margin{2 * at_most, 2 * at_most, 2 * at_most};
    FaceId near;
    to.hierarchy->for_each_meeting({corner - margin, corner + margin}, [&](std::uint32_t face) {
      near = FaceId(face);
      return false;
    });
    if (!near.is_valid()) return at_most;  // only if that is not a bound
    faces.push_back({FaceId(f), at_most, near});
  }
  return bounded_distance(from, faces, to, enough, monitor);
}

}  // namespace algebra3d
