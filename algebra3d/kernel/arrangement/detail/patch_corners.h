#pragma once

#include "algebra3d/kernel/arrangement/detail/selection.h"

namespace algebra3d::arrangement {

/// The nodes that are corners of faces which a result takes over.
class PatchCorners {
 public:
  /// Cost: linear in the nodes and in the faces round them.
  PatchCorners(const Subdivision& subdivision, const KeptPatches& kept);

  /// True if a face that is taken over has a corner at the node.
  bool is_corner(NodeId node) const { return is_corner_[node]; }

 private:
  IdVector<NodeId, bool> is_corner_;
};

/// How a result takes the face over: as its patch; 0 for faces in facets.
inline int kept_of_face(InputFaceId face, const Patches& patches, const KeptPatches& kept) {
  const PatchId patch = patches.of_face[face];
  return patch.is_none() ? 0 : kept[patch];
}

}  // namespace algebra3d::arrangement
