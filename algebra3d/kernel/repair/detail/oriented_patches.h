#pragma once

#include <memory>

#include "algebra3d/base/strong_id.h"
#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "base/id_vector.h"

namespace algebra3d {

/// A manifold patch of a soup.
using ManifoldPatchId = StrongId<struct ManifoldPatchTag>;

/// The manifold patches of a soup (manifold_patches.h), with the triangles to flip so that each patch is oriented
/// consistently.
class OrientedPatches {
 public:
  /// Finds the patches, numbered in the order of their first triangle. In each the orientation with more area stays.
  explicit OrientedPatches(const IndexedSoup& soup);

  const TriangleMesh& mesh() const { return *mesh_; }
  std::size_t count() const { return count_; }
  ManifoldPatchId of(FaceId triangle) const { return patch_of_[triangle]; }
  /// Per triangle: whether it is to be flipped.
  const IdVector<FaceId, bool>& is_flipped() const { return is_flipped_; }
  /// Flips whole patches.
  void flip(const IdVector<ManifoldPatchId, bool>& patches);

  /// 1 if the triangle of `h`, after its flip, runs along the edge in the same direction as that of `reference` after
  /// its own, else -1.
  int direction(HalfedgeId h, HalfedgeId reference) const;

 private:
  template <typename Visit>
  void for_each_neighbour(FaceId triangle, Visit visit) const;
  void grow_patch(const IndexedSoup& soup, FaceId start);

  std::shared_ptr<const TriangleMesh> mesh_;
  IdVector<FaceId, ManifoldPatchId> patch_of_;
  IdVector<FaceId, bool> is_flipped_;
  std::size_t count_ = 0;
};

}  // namespace algebra3d
