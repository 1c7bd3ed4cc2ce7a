#pragma once

#include <deque>
#include <string>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/arrangement/detail/candidates.h"
#include "algebra3d/kernel/arrangement/detail/contact.h"
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

/// Two faces that touch, and their common part.
struct PairContact {
  InputFaceId first_face, second_face;
  TriangleContact contact;
};

/// Output of stage 2: the pairs of faces that touch.
struct PairContacts {
  std::vector<PairContact> contacts;
  /// Planes of faces with corners that are not doubles, and of faces that were compared with such.
  PlanesOfFaces planes;
};

/// Stage 2: computes the common part of the faces of each pair; keeps the pairs that touch, in their order. Coplanar
/// faces touch if they have a point in common. Errors: interrupted. Cost: linear in the pairs, of which each takes some
/// ten predicates.
Result<PairContacts> find_pair_contacts(const Operands& operands, const Candidates& candidates, const Monitor& monitor);

/// Every violated invariant, one sentence each: both faces exist and are of different operands; they meet in a point,
/// in a segment or in one plane as the contact says, by intersect_triangles, which shares no code with contact_of; ends
/// are at places, and run along an edge if the contact does. Cost: linear, with exact predicates.
std::vector<std::string> audit(const Operands& operands, const PairContacts& contacts);

}  // namespace algebra3d::arrangement
