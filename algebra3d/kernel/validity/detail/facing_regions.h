#pragma once

#include <cstdint>
#include <optional>

#include "algebra3d/kernel/exact/predicates_filter.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "base/id_vector.h"

namespace algebra3d {

using RegionId = StrongId<struct RegionTag>;

/// One of the six directions along the axes.
struct AxisDirection {
  Projection projection = Projection::xy;  ///< along the axis
  bool is_negative = false;
};

/// Connected faces that all show their front in one direction.
struct FacingRegion {
  std::optional<AxisDirection> direction;  ///< none: a single face that may be degenerate
  FaceId first;                            ///< the lowest face
  std::uint32_t face_count = 1;
};

/// The faces of a mesh divided into regions that are connected across manifold edges and face one direction; seen along
/// it, every triangle turns counter-clockwise. Exact. A face for which no direction can be determined from its doubles
/// is a region by itself.
struct FacingRegions {
  IdVector<FaceId, RegionId> of_face;
  IdVector<RegionId, FacingRegion> regions;  ///< in order of their lowest faces
};

/// Grows regions from the lowest faces that are in none, as far as the front is seen at an angle that is not too
/// narrow. Cost: linear, some 15 ns per face.
FacingRegions find_facing_regions(const TriangleMesh& mesh);

}  // namespace algebra3d
