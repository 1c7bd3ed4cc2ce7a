#include "algebra3d/kernel/validity/detail/front_ray.h"

#include <algorithm>
#include <vector>

#include "algebra3d/kernel/exact/inner_point.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/exact/vertical_line.h"

namespace algebra3d {
namespace {

/// True if the face lies on one side of the vertical plane through p along an axis. Rounded numbers decide, as rounding
/// is monotonic.
bool is_beside(const TriangleMesh& mesh, FaceId face, const Vec3& p, std::size_t axis) {
  const std::vector<Vec3>& points = mesh.points().approx();
  const auto [a, b, c] = mesh.triangle(face);
  const auto [low, high] = std::minmax({points[a][axis], points[b][axis], points[c][axis]});
  return high < p[axis] || p[axis] < low;
}

}  // namespace

FrontRay::FrontRay(const TriangleRef& face, int attempt)
    : start_(inner_point(face, attempt)), upward_(orient2d(Projection::xy, face[0], face[1], face[2])) {}

// In front is above the point if the normal points up. Upwards, triangles whose normals point up are left through their
// fronts: each counts one for the place before it. Downwards it is those whose normals point down.
void FrontRay::cross(const TriangleMesh& mesh, FaceId face) {
  if (is_beside(mesh, face, start_.approx(), 0) || is_beside(mesh, face, start_.approx(), 1)) return;
  const LineCrossing crossing = cross_vertical_line(start_, mesh.corners(face));
  if (crossing.sign == 0) return;
  if (crossing.side == 0) starts_on_other_ = true;
  if (crossing.side == -upward_) winding_ += upward_ * crossing.sign;
}

bool is_vertical(const TriangleRef& face) {
  return orient2d(Projection::xy, face[0], face[1], face[2]) == 0;
}

}  // namespace algebra3d
