#include "algebra3d/repair/facet_parts.h"

namespace algebra3d {

arrangement::DisjointSets parts_across_simple_edges(const TriangleMesh& mesh) {
  arrangement::DisjointSets parts(mesh.face_count());
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    if (const HalfedgeId other = mesh.opposite(HalfedgeId(h)); other.is_valid()) parts.unite(h / 3, other.index() / 3);
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n)
    if (const auto edge = mesh.nonmanifold_edge(n); edge.size() == 2)
      parts.unite(edge[0].index() / 3, edge[1].index() / 3);
  return parts;
}

}  // namespace algebra3d
