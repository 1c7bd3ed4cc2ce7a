#include "algebra3d/kernel/halfedge/dual.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/normals.h"
#include "base/large_allocator.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

/// Appends the faces of a fan; false, and nothing is appended, if it is not closed or has fewer than three.
template <typename Layout>
bool append_closed_fan(const HalfedgeMesh<Layout>& mesh, HalfedgeId first, LargeVector<std::uint32_t>& corners) {
  const std::size_t begin = corners.size();
  HalfedgeId h = first;
  do {
    corners.push_back(mesh.face(h).index());
    h = mesh.opposite(mesh.prev(h));
  } while (h.is_valid() && h != first);
  if (h.is_valid() && corners.size() >= begin + 3) return true;
  corners.resize(begin);
  return false;
}

}  // namespace

template <typename Layout>
Result<PolygonMesh> dual_mesh(const HalfedgeMesh<Layout>& mesh, const Monitor& monitor) {
  constexpr std::size_t kPerTask = 4096;
  std::vector<Vec3> points;
  resize_large(points, mesh.face_count());
  parallel_for((mesh.face_count() + kPerTask - 1) / kPerTask, 1, [&](std::size_t task) {
    if (monitor.is_cancelled()) return;
    const std::size_t end = std::min(mesh.face_count(), (task + 1) * kPerTask);
    for (std::size_t f = task * kPerTask; f < end; ++f)
      points[f] = nearest_mean(mesh.points(), corner_indices(mesh, FaceId(f)));
  });
  LargeVector<std::uint32_t> corners, starts;
  starts.push_back(0);
  for (const VertexId v : vertices(mesh)) {
    if (v.index() % kPerTask == 0) A3D_TRY(monitor.check());
    for (const HalfedgeId first : mesh.fans(v))
      if (append_closed_fan(mesh, first, corners)) starts.push_back(static_cast<std::uint32_t>(corners.size()));
  }
  A3D_TRY(monitor.check());
  return PolygonMesh(PointArray(std::move(points)), PolygonLayout(std::move(starts)), std::move(corners));
}

template Result<PolygonMesh> dual_mesh(const HalfedgeMesh<TriangleLayout>&, const Monitor&);
template Result<PolygonMesh> dual_mesh(const HalfedgeMesh<PolygonLayout>&, const Monitor&);

}  // namespace algebra3d
