#include "algebra3d/arrangement/detail/patches.h"

#include "algebra3d/base/disjoint_sets.h"

namespace algebra3d::arrangement {
namespace {

/// Unites the faces of one operand that are in no facet and meet along an edge. The faces are taken in their order and
/// not from neighbour to neighbour, since that jumps about in memory.
void unite_neighbours(const Operands& operands, const Facets& facets, OperandId operand, DisjointSets& faces) {
  const TriangleMesh& mesh = operands.mesh(operand);
  const auto unite = [&](InputFaceId face, HalfedgeId along) {
    const InputFaceId neighbour = operands.input(operand, TriangleMesh::face(along));
    if (neighbour < face && facets.of_face[neighbour].is_none()) faces.unite(face.index(), neighbour.index());
  };
  for (const InputFaceId face : operands.faces(operand)) {
    if (!facets.of_face[face].is_none()) continue;
    for (const InputHalfedgeId halfedge : Operands::halfedges(face)) {
      const HalfedgeId h = operands.in_mesh(operand, halfedge);
      if (const HalfedgeId other = mesh.opposite(h); other.is_valid())
        unite(face, other);
      else if (mesh.is_nonmanifold(h))
        for (const HalfedgeId along : mesh.edge_halfedges(h)) unite(face, along);
    }
  }
}

}  // namespace

Patches find_patches(const Operands& operands, const Facets& facets) {
  DisjointSets faces(operands.face_count());
  for (const OperandId operand : operands.ids()) unite_neighbours(operands, facets, operand, faces);

  Patches result;
  result.of_face.resize(operands.face_count());
  for (const OperandId operand : operands.ids())
    for (const InputFaceId face : operands.faces(operand)) {
      if (!facets.of_face[face].is_none()) continue;
      // The lowest face of a set is met first and gives its name.
      const InputFaceId name(faces.find(face.index()));
      if (result.of_face[name].is_none()) result.of_face[name] = result.patches.push_back({operand, face});
      result.of_face[face] = result.of_face[name];
    }
  return result;
}

}  // namespace algebra3d::arrangement
