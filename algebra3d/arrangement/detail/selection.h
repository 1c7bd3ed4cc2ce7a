#pragma once

#include <functional>

#include "algebra3d/arrangement/detail/ids.h"

namespace algebra3d::arrangement {

/// The sub-facets and patches of an arrangement that a result takes: 1 for one that it takes, -1 for one that it takes
/// flipped, 0 for others. Made by SolidArrangement::faces, of a FaceRule, the Classification and the WindingJumps
/// (arrangement.cpp; `solid` calls `faces` with the FaceRule that follows from its KeepRule), or by
/// surface_arrangement.cpp, of a SurfaceRule and the facets that cover a sub-facet.
struct Selection {
  /// The choice for the sub-facet at a side of a sub-edge, as seen from the front of its plane. Must give the same for
  /// all sides of a sub-facet. Called only for sides on which a facet lies.
  std::function<int(SubEdgeSide side)> sub_facet;
  /// The choice for a patch.
  std::function<int(PatchId patch)> patch;
};

}  // namespace algebra3d::arrangement
