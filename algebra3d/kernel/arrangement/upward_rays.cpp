#include "algebra3d/kernel/arrangement/upward_rays.h"

#include <array>

#include "algebra3d/kernel/arrangement/detail/cell_above.h"
#include "algebra3d/kernel/arrangement/detail/faces_above.h"
#include "algebra3d/kernel/arrangement/detail/operands.h"

namespace algebra3d {

struct UpwardRays::Parts {
  explicit Parts(const TriangleMesh& mesh) : list{{{&mesh, 0}}} {}

  std::array<Operand, 1> list;
  arrangement::Operands operands{list};
  arrangement::FaceTree tree{operands};
  arrangement::FacesAbove faces_above{operands, tree};
};

UpwardRays::UpwardRays(const TriangleMesh& mesh) : parts_(std::make_unique<Parts>(mesh)) {}
UpwardRays::~UpwardRays() = default;

bool UpwardRays::for_each(const PointRef& point, const Visit& visit) {
  return parts_->faces_above.for_each(
      point, [&](arrangement::InputFaceId face, int sign) { return visit(FaceId(face.index()), sign > 0); });
}

bool leads_up_to_front(const TriangleRef& triangle) {
  return arrangement::is_cell_above_in_front(triangle);
}

}  // namespace algebra3d
