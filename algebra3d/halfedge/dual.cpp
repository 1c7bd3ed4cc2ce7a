#include "algebra3d/halfedge/dual.h"

#include <utility>

#include "algebra3d/halfedge/circulators.h"
#include "algebra3d/halfedge/normals.h"

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
PolygonMesh dual_mesh(const HalfedgeMesh<Layout>& mesh) {
  PointArray points;
  points.reserve(mesh.face_count());
  for (const FaceId f : faces(mesh)) points.push_back(nearest_mean(mesh.points(), corner_indices(mesh, f)));
  LargeVector<std::uint32_t> corners, starts;
  starts.push_back(0);
  for (const VertexId v : vertices(mesh))
    for (const HalfedgeId first : mesh.fans(v))
      if (append_closed_fan(mesh, first, corners)) starts.push_back(static_cast<std::uint32_t>(corners.size()));
  return {std::move(points), PolygonLayout(std::move(starts)), std::move(corners)};
}

template PolygonMesh dual_mesh(const HalfedgeMesh<TriangleLayout>&);
template PolygonMesh dual_mesh(const HalfedgeMesh<PolygonLayout>&);

}  // namespace algebra3d
