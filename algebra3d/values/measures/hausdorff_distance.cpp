#include "algebra3d/values/measures/hausdorff_distance.h"

#include <array>

#include "algebra3d/values/spatial_relations/boundary_faces.h"

namespace algebra3d {

Result<std::optional<FarthestPoint>> hausdorff_distance(const SpatialSet& a, const SpatialSet& b,
                                                        const Monitor& monitor) {
  const BoundaryFaces first(a), second(b);
  if (first.operand().mesh->is_empty() || second.operand().mesh->is_empty()) return std::optional<FarthestPoint>();
  return farthest_point(
      std::array<FarthestSearch, 2>{{{first.operand(), second.operand()}, {second.operand(), first.operand()}}},
      monitor);
}

}  // namespace algebra3d
