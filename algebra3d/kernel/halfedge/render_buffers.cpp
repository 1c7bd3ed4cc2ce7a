#include "algebra3d/kernel/halfedge/render_buffers.h"

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "base/interruption_scope.h"

namespace algebra3d {
namespace {

std::array<float, 3> floats(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

Vec3 middle_of(const PointArray& points) {
  Box3 box;
  for (const Vec3& p : points.approx()) box.extend(p);
  if (box.is_empty()) return {};
  return 0.5 * box.min + 0.5 * box.max;
}

/// The vertices: one for each corner normal, and so none of vertices without faces.
template <typename Layout>
RenderBuffers with_vertices(const HalfedgeMesh<Layout>& mesh, const CornerNormals& normals) {
  RenderBuffers buffers;
  buffers.origin = middle_of(mesh.points());
  buffers.mesh_vertices.resize(normals.normals.size());
  for (const HalfedgeId h : halfedges(mesh)) {
    poll_interruption_at(h.index());
    buffers.mesh_vertices[normals.of_corner[h.index()]] = mesh.origin(h).index();
  }
  buffers.positions.reserve(normals.normals.size());
  for (const std::uint32_t vertex : buffers.mesh_vertices)
    buffers.positions.push_back(floats(mesh.points().approx()[vertex] - buffers.origin));
  buffers.normals.reserve(normals.normals.size());
  for (const Vec3& normal : normals.normals) buffers.normals.push_back(floats(normal));
  return buffers;
}

}  // namespace

template <typename Layout>
RenderBuffers render_buffers(const HalfedgeMesh<Layout>& mesh, std::span<const std::array<HalfedgeId, 3>> triangles,
                             const CornerNormals& normals) {
  RenderBuffers buffers = with_vertices(mesh, normals);
  buffers.triangles.reserve(triangles.size());
  buffers.faces.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    buffers.triangles.push_back(
        {normals.of_corner[a.index()], normals.of_corner[b.index()], normals.of_corner[c.index()]});
    buffers.faces.push_back(mesh.face(a).index());
  }
  return buffers;
}

RenderBuffers render_buffers(const TriangleMesh& mesh, const CornerNormals& normals) {
  std::vector<std::array<HalfedgeId, 3>> triangles;
  triangles.reserve(mesh.face_count());
  for (const FaceId f : faces(mesh)) {
    poll_interruption_at(f.index());
    triangles.push_back({TriangleMesh::halfedge(f, 0), TriangleMesh::halfedge(f, 1), TriangleMesh::halfedge(f, 2)});
  }
  return render_buffers<TriangleLayout>(mesh, triangles, normals);
}

template RenderBuffers render_buffers(const HalfedgeMesh<TriangleLayout>&, std::span<const std::array<HalfedgeId, 3>>,
                                      const CornerNormals&);
template RenderBuffers render_buffers(const HalfedgeMesh<PolygonLayout>&, std::span<const std::array<HalfedgeId, 3>>,
                                      const CornerNormals&);

}  // namespace algebra3d
