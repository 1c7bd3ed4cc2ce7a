#include "algebra3d/kernel/arrangement/detail/patch_corners.h"

#include "algebra3d/kernel/halfedge/circulators.h"

namespace algebra3d::arrangement {

PatchCorners::PatchCorners(const Subdivision& subdivision, const KeptPatches& kept)
    : is_corner_(subdivision.complex.nodes.size()) {
  const Operands& operands = subdivision.operands;
  for (const auto& [vertex, node] : subdivision.complex.nodes_of_vertices) {
    const OperandId operand = operands.operand_of(vertex);
    for (const FaceId face : faces_around(operands.mesh(operand), operands.in_mesh(operand, vertex)))
      if (kept_of_face(operands.input(operand, face), subdivision.patches, kept) != 0) is_corner_[node] = true;
  }
}

}  // namespace algebra3d::arrangement
