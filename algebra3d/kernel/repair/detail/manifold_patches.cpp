#include "algebra3d/kernel/repair/detail/manifold_patches.h"

#include "algebra3d/kernel/halfedge/circulators.h"

namespace algebra3d {

DisjointIds<FaceId> manifold_patches(const TriangleMesh& mesh) {
  DisjointIds<FaceId> patches(mesh.face_count());
  for (const HalfedgeId h : halfedges(mesh))
    if (const HalfedgeId other = mesh.opposite(h); other.is_valid())
      patches.unite(TriangleMesh::face(h), TriangleMesh::face(other));
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n)
    if (const auto edge = mesh.nonmanifold_edge(n); edge.size() == 2)
      patches.unite(TriangleMesh::face(edge[0]), TriangleMesh::face(edge[1]));
  return patches;
}

}  // namespace algebra3d
