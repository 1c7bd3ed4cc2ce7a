#pragma once

#include <cstdint>

#include "algebra3d/kernel/arrangement/detail/subdivision.h"

namespace algebra3d::arrangement {

/// How a result takes each patch: 1 if it takes the faces over, -1 if it takes them flipped, else 0.
using KeptPatches = IdVector<PatchId, int>;

/// The sub-facets and patches of an arrangement that a result takes. Made by SolidArrangement, of a FaceRule, the
/// Classification and the WindingJumps (arrangement.cpp; a KeepRule gives the FaceRule that follows from it), or by
/// surface_arrangement.cpp, of a SurfaceRule and the facets that cover a sub-facet.
struct Selection {
  /// How the result takes the sub-facet at each side of each sub-edge, as seen from the front of its plane; 0 where no
  /// facet lies. The same for all sides of a sub-facet.
  IdVector<SubEdgeSide, std::int8_t> sub_facets;
  KeptPatches patches;

  /// `of_side(side)` and `of_patch(patch)` give 1, -1 or 0. Both are called in order, on the calling thread.
  template <typename OfSide, typename OfPatch>
  static Selection of(const Subdivision& subdivision, const OfSide& of_side, const OfPatch& of_patch) {
    Selection selection;
    selection.sub_facets.reserve(subdivision.sub_edges.sides().size());
    for (const SubEdgeSide side : subdivision.sub_edges.sides())
      selection.sub_facets.push_back(static_cast<std::int8_t>(of_side(side)));
    selection.patches.reserve(subdivision.patches.patches.size());
    for (const PatchId patch : subdivision.patches.ids()) selection.patches.push_back(of_patch(patch));
    return selection;
  }
};

}  // namespace algebra3d::arrangement
