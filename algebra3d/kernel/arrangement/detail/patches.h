#pragma once

#include <string>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/facets.h"

namespace algebra3d::arrangement {

/// A patch: connected faces of one operand that are in no facet (facets.h), because no face of their coplanar facet
/// touches another operand. The result takes a patch over as it is, or drops it, as a whole.
struct Patch {
  OperandId operand;
  InputFaceId first_face;  ///< the lowest
};

/// Output of stage 7: all patches, that is all faces that the arrangement leaves as they are.
struct Patches {
  IdVector<InputFaceId, PatchId> of_face;  ///< none for faces in facets
  IdVector<PatchId, Patch> patches;        ///< ascending by first faces

  IdRange<PatchId> ids() const { return patches.ids(); }
  const Patch& operator[](PatchId patch) const { return patches[patch]; }
};

/// Stage 7: finds the patches. It needs the facets only, and may run beside stages 5 and 6. Cost: linear in all faces.
Patches find_patches(const Operands& operands, const Facets& facets);

/// Every violated invariant, one sentence each: a face is in a facet or in a patch; a patch is of one operand, begins
/// with its lowest face, and goes on across edges as far as no facet is there; patches ascend. Cost: linear.
std::vector<std::string> audit(const Operands& operands, const Facets& facets, const Patches& patches);

}  // namespace algebra3d::arrangement
