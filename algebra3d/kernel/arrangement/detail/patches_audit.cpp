#include "algebra3d/kernel/arrangement/detail/patches.h"
#include "algebra3d/kernel/arrangement/detail/stage_audit.h"

namespace algebra3d::arrangement {
namespace {

/// Faces across an edge are of one patch, unless one is in a facet.
void audit_neighbours(const Operands& operands, const Patches& patches, InputFaceId face, Violations& violations) {
  for (const InputHalfedgeId h : Operands::halfedges(face)) {
    const InputHalfedgeId other = operands.opposite(h);
    if (other.is_none()) continue;
    const InputFaceId neighbour = Operands::face(other);
    const PatchId beyond = patches.of_face[neighbour];
    violations.expect(beyond.is_none() || beyond == patches.of_face[face], "patch {} goes on from face {} in face {}",
                      patches.of_face[face].index(), face.index(), neighbour.index());
  }
}

}  // namespace

std::vector<std::string> audit(const Operands& operands, const Facets& facets, const Patches& patches) {
  Violations violations;
  if (!violations.expect(patches.of_face.size() == operands.face_count(), "{} faces are known, not {}",
                         patches.of_face.size(), operands.face_count()))
    return violations.take();
  std::size_t found = 0;
  for (const InputFaceId face : operands.faces()) {
    const PatchId patch = patches.of_face[face];
    violations.expect(patch.is_none() != facets.of_face[face].is_none(),
                      "face {} is in a facet and a patch, or neither", face.index());
    if (patch.is_none()) continue;
    // The first face of each patch is its lowest, and patches come in the order of these.
    if (patch.index() == found) {
      violations.expect(patches.patches.size() > found && patches[patch].first_face == face,
                        "patch {} does not begin with its first face {}", patch.index(), face.index());
      ++found;
    }
    if (!violations.expect(patch.index() < found && patch.index() < patches.patches.size(),
                           "face {} is in patch {}, which has not begun", face.index(), patch.index()))
      continue;
    violations.expect(patches[patch].operand == operands.operand_of(face), "face {} is in a patch of another operand",
                      face.index());
    audit_neighbours(operands, patches, face, violations);
  }
  violations.expect(found == patches.patches.size(), "{} patches have faces, of {}", found, patches.patches.size());
  return violations.take();
}

}  // namespace algebra3d::arrangement
