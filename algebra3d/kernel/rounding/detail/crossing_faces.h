#pragma once

#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/detail/snapped_faces.h"
#include "algebra3d/kernel/search/box_hierarchy.h"

namespace algebra3d {

/// Two faces, the one with the smaller number first.
using FacePair = std::pair<std::size_t, std::size_t>;

/// Finds faces that cross, again and again while faces change. The faces must outlive this. Cost: that of a hierarchy
/// over all given faces.
class CrossingSearch {
 public:
  explicit CrossingSearch(const SnappedFaces& faces);

  /// The pairs of faces that share more than a point or a whole edge of both, and at least one of which is open;
  /// ascending. Faces without area, and faces with the same corners, cross nothing. Exact. Errors: interrupted. Cost:
  /// that of a hierarchy over the changed and the open faces, and of their pairs of boxes; as long as nothing has
  /// changed, that of find_crossings (validity.h).
  Result<std::vector<FacePair>> find(const std::atomic<bool>* cancel) const;

 private:
  Result<std::vector<FacePair>> find_among_given(const std::atomic<bool>* cancel) const;
  Result<std::vector<FacePair>> find_of(const std::vector<std::size_t>& wanted, const std::atomic<bool>* cancel) const;

  const SnappedFaces& faces_;
  TriangleMesh given_mesh_;
  BoxHierarchy given_;
  std::vector<bool> is_flat_;  // per given face
};

}  // namespace algebra3d
