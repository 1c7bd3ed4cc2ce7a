#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/arrangement/facets.h"

namespace algebra3d::arrangement {

/// Faces of one operand that touch nothing and hang together across edges.
struct Patch {
  std::uint32_t operand;
  std::uint32_t first_face;
};

/// What the arrangement leaves as it is: the faces that are in no facet, by patches.
struct Patches {
  std::vector<std::uint32_t> of_face;  ///< patch of each face; kNone for those in facets
  std::vector<Patch> patches;
};

/// Cost: linear in all faces.
Patches find_patches(const Operands& operands, const Facets& facets);

}  // namespace algebra3d::arrangement
