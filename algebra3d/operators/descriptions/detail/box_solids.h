#pragma once

#include "algebra3d/values/spatial_relations/box_meshes.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {

/// The solid of an operand that may be a solid or a box. Undefined for a flat box.
inline Maybe<Volume3d> solid_of(const Volume3d& solid) {
  return solid;
}
inline Maybe<Volume3d> solid_of(const Box3& box) {
  if (dimension_of(box) < 3) return Undefined{"a flat box is not a solid"};
  return solid_of_box(box);
}

}  // namespace algebra3d
