#include "algebra3d/arrangement/planes_of_faces.h"

namespace algebra3d::arrangement {

const IntegerPlane* PlanesOfFaces::find(std::uint32_t face) const {
  if (const IntegerPlane* known = operands_.plane(face); known != nullptr) return known;
  return numbers_.empty() || numbers_[face] == kNone ? nullptr : &made_[numbers_[face]];
}

const IntegerPlane& PlanesOfFaces::get(std::uint32_t face) {
  if (const IntegerPlane* plane = find(face); plane != nullptr) return *plane;
  if (numbers_.empty()) numbers_.resize(operands_.face_count(), kNone);
  numbers_[face] = static_cast<std::uint32_t>(made_.size());
  return made_.emplace_back(IntegerPlane::through(operands_.corners(face)));
}

}  // namespace algebra3d::arrangement
