#include "algebra3d/kernel/repair/detail/oriented_patches.h"

#include <vector>

#include "algebra3d/kernel/halfedge/circulators.h"

namespace algebra3d {

OrientedPatches::OrientedPatches(const IndexedSoup& soup)
    : mesh_(soup.mesh()), patch_of_(soup.triangles.size()), is_flipped_(soup.triangles.size()) {
  for (const FaceId triangle : patch_of_.ids())
    if (patch_of_[triangle].is_none()) grow_patch(soup, triangle);
}

/// Calls visit(neighbour, agrees) for the triangles across edges of two triangles.
template <typename Visit>
void OrientedPatches::for_each_neighbour(FaceId triangle, Visit visit) const {
  for (const HalfedgeId h : halfedges_of(*mesh_, triangle)) {
    if (const HalfedgeId other = mesh_->opposite(h); other.is_valid()) {
      visit(TriangleMesh::face(other), true);
    } else if (mesh_->is_nonmanifold(h)) {
      const auto edge = mesh_->edge_halfedges(h);
      if (edge.size() == 2) visit(TriangleMesh::face(edge[edge[0] == h ? 1 : 0]), false);
    }
  }
}

void OrientedPatches::grow_patch(const IndexedSoup& soup, FaceId start) {
  const ManifoldPatchId id(count_++);
  std::vector<FaceId> patch{start};
  patch_of_[start] = id;
  double flipped_area = 0, other_area = 0;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const bool is_flipped = is_flipped_[patch[i]];
    (is_flipped ? flipped_area : other_area) += soup.area(patch[i]);
    for_each_neighbour(patch[i], [&](FaceId neighbour, bool agrees) {
      if (!patch_of_[neighbour].is_none()) return;
      patch_of_[neighbour] = id;
      is_flipped_[neighbour] = is_flipped == agrees;
      patch.push_back(neighbour);
    });
  }
  if (flipped_area > other_area)
    for (const FaceId triangle : patch) is_flipped_[triangle] = !is_flipped_[triangle];
}

void OrientedPatches::flip(const IdVector<ManifoldPatchId, bool>& patches) {
  for (const FaceId triangle : patch_of_.ids())
    if (patches[patch_of_[triangle]]) is_flipped_[triangle] = !is_flipped_[triangle];
}

int OrientedPatches::direction(HalfedgeId h, HalfedgeId reference) const {
  const bool is_forward = mesh_->origin(h) == mesh_->origin(reference);
  return is_forward != is_flipped_[TriangleMesh::face(h)] ? 1 : -1;
}

}  // namespace algebra3d
