#include "algebra3d/kernel/arrangement/detail/operands.h"
#include "algebra3d/kernel/arrangement/detail/stage_audit.h"
#include "algebra3d/kernel/arrangement/winding_vector.h"

namespace algebra3d::arrangement {

std::vector<std::string> audit(const Operands& operands) {
  Violations violations;
  std::size_t face_count = 0;
  for (const OperandId operand : operands.ids()) {
    const std::size_t own = operands.mesh(operand).face_count();
    const IdRange<InputFaceId> faces = operands.faces(operand);
    violations.expect(operands.group(operand) < WindingVector::kGroupCount, "operand {} has the group {}",
                      operand.index(), operands.group(operand));
    violations.expect(operands.hierarchy(operand).face_count() == own, "operand {} has {} faces and a hierarchy of {}",
                      operand.index(), own, operands.hierarchy(operand).face_count());
    violations.expect(faces.size() == own && faces.front().index() == face_count,
                      "operand {} has the faces from {} on, {} of them; expected {} from {} on", operand.index(),
                      faces.front().index(), faces.size(), own, face_count);
    if (own > 0)
      violations.expect(operands.operand_of(faces.front()) == operand, "face {} is not found in operand {}",
                        faces.front().index(), operand.index());
    face_count += own;
  }
  violations.expect(operands.face_count() == face_count, "{} faces, but {} in operands", operands.face_count(),
                    face_count);
  return violations.take();
}

}  // namespace algebra3d::arrangement
