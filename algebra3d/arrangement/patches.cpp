#include "algebra3d/arrangement/patches.h"

#include "algebra3d/arrangement/disjoint_sets.h"

namespace algebra3d::arrangement {
namespace {

/// Unites the faces of one operand that are in no facet and meet along an edge. The faces are taken in their order and
/// not from neighbour to neighbour, since that jumps about in memory.
void unite_neighbours(const Operands& operands, const Facets& facets, std::uint32_t operand, DisjointSets& faces) {
  const TriangleMesh& mesh = operands.mesh(operand);
  const std::uint32_t first = operands.first_face(operand);
  const auto unite = [&](std::uint32_t face, HalfedgeId along) {
    const std::uint32_t neighbour = first + TriangleMesh::face(along).index();
    if (neighbour < face && facets.of_face(neighbour) == kNone) faces.unite(face, neighbour);
  };
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (facets.of_face(first + f) != kNone) continue;
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const HalfedgeId h = TriangleMesh::halfedge(FaceId(f), corner);
      if (const HalfedgeId other = mesh.opposite(h); other.is_valid())
        unite(first + f, other);
      else if (mesh.is_nonmanifold(h))
        for (const HalfedgeId along : mesh.edge_halfedges(h)) unite(first + f, along);
    }
  }
}

}  // namespace

Patches find_patches(const Operands& operands, const Facets& facets) {
  DisjointSets faces(operands.face_count());
  for (std::uint32_t operand = 0; operand < operands.count(); ++operand)
    unite_neighbours(operands, facets, operand, faces);

  Patches result;
  result.of_face.assign(operands.face_count(), kNone);
  for (std::uint32_t operand = 0; operand < operands.count(); ++operand)
    for (std::uint32_t face = operands.first_face(operand); face < operands.first_face(operand + 1); ++face) {
      if (facets.of_face(face) != kNone) continue;
      // The lowest face of a set is met first and gives its name.
      const std::uint32_t name = faces.find(face);
      if (result.of_face[name] == kNone) {
        result.of_face[name] = static_cast<std::uint32_t>(result.patches.size());
        result.patches.push_back({operand, face});
      }
      result.of_face[face] = result.of_face[name];
    }
  return result;
}

}  // namespace algebra3d::arrangement
