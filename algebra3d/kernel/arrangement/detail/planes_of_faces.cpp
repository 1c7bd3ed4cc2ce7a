#include "algebra3d/kernel/arrangement/detail/planes_of_faces.h"

namespace algebra3d::arrangement {

const IntegerPlane* PlanesOfFaces::find(InputFaceId face) const {
  if (const IntegerPlane* known = operands_->plane(face); known != nullptr) return known;
  return computed_of_.empty() ? nullptr : computed_of_[face];
}

const IntegerPlane& PlanesOfFaces::get(InputFaceId face) {
  if (const IntegerPlane* plane = find(face); plane != nullptr) return *plane;
  if (computed_of_.empty()) computed_of_.resize(operands_->face_count(), nullptr);
  computed_of_[face] = &computed_.emplace_back(IntegerPlane::through(operands_->corners(face)));
  return *computed_of_[face];
}

}  // namespace algebra3d::arrangement
