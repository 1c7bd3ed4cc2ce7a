#pragma once

#include <vector>

#include "algebra3d/kernel/repair/detail/oriented_patches.h"

namespace algebra3d {

/// How strongly two manifold patches agree that are neighbours around non-manifold edges: the length of the edges at
/// which they run in opposite directions, less the length of the others.
struct PatchLink {
  double length = 0;
  ManifoldPatchId patch, other;
};

/// The links of all patches, the most certain first. Empty if every non-manifold edge is balanced already. Around an
/// edge in which a solid touches itself, inside and outside alternate, so adjacent triangles run along the edge in
/// opposite directions. Edges with an odd number of triangles, or with triangles that coincide or have collinear
/// corners, are ignored. Exact but for the lengths.
std::vector<PatchLink> patch_links(const OrientedPatches& patches);

/// Flips patches so that linked patches agree, following the most certain links first. In each cluster, that is patches
/// which links connect, the orientation with more area stays.
void flip_linked_patches(const IndexedSoup& soup, OrientedPatches& patches);

}  // namespace algebra3d
