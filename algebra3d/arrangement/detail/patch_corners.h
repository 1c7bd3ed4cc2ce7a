#pragma once

#include "algebra3d/arrangement/detail/subdivision.h"

namespace algebra3d::arrangement {

/// Selection::patch of every patch: 1 if the result takes the faces over, -1 if it takes them flipped, else 0.
using KeptPatches = IdVector<PatchId, int>;

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
