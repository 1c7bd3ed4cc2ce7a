#pragma once

#include <deque>

#include "algebra3d/kernel/arrangement/detail/operands.h"
#include "algebra3d/kernel/exact/integer_plane.h"

namespace algebra3d::arrangement {

/// Planes of single faces of the operands: those that the meshes keep, and others that are computed when asked for.
/// Stage 2 computes here; make_facets copies what it needs into Plane::coefficients; from stage 4 on there is
/// PlaneCoefficients. Refers to the operands.
class PlanesOfFaces {
 public:
  explicit PlanesOfFaces(const Operands& operands) : operands_(&operands) {}

  /// The plane of the face, which is computed if it is not known. References are valid as long as this object.
  const IntegerPlane& get(InputFaceId face);
  /// The plane of the face; null if the mesh does not keep it and `get` has not been called for it.
  const IntegerPlane* find(InputFaceId face) const;

 private:
  const Operands* operands_;
  IdVector<InputFaceId, const IntegerPlane*> computed_of_;  // into `computed_`, or null; empty before the first
  std::deque<IntegerPlane> computed_;
};

}  // namespace algebra3d::arrangement
