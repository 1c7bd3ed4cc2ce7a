#include "algebra3d/distance/distance_bound.h"

#include <algorithm>
#include <vector>

#include "algebra3d/distance/detail/face_bounds.h"
#include "algebra3d/halfedge/boxes.h"

namespace algebra3d {

Result<double> bounded_distance(const TriangleMesh& from, std::span<const BoundedFace> faces, const DistanceOperand& to,
                                double enough, const Monitor& monitor) {
  std::vector<BoundedFace> by_bound(faces.begin(), faces.end());
  std::ranges::stable_sort(by_bound, std::ranges::greater(), &BoundedFace::at_most);
  const Box3 box = unite(Box3::around(from.points().approx()), to.hierarchy->bounds());
  for (const BoundedFace& face : by_bound) {
    if (face.at_most <= enough) break;
    distances::FaceBounds<WideVec3> bounds(from, to, box, enough, monitor);
    const double upper = bounds.of(face.face, {face.near, face.near, face.near}).upper;
    ALGEBRA3D_RETURN_IF_ERROR(monitor.check());
    enough = std::max(enough, std::min(upper, face.at_most));
  }
  return enough;
}

}  // namespace algebra3d
