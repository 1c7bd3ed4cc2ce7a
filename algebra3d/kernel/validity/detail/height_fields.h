#pragma once

#include <cstdint>
#include <optional>
#include <vector>

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

/// Regions of a mesh that are proved to be height fields: seen along an axis, no two of their triangles overlap. So two
/// faces of one field share nothing, one point, or a whole common edge; none is degenerate, no two have the same
/// corners. A region is proved by its boundary alone, which replaces the tests of the pairs of its faces. Nearly all
/// faces of nearly all meshes are in a few large fields, or in as many as the mesh has flat sides. Source:
/// [volino1994].
class HeightFields {
 public:
  /// Finds regions and proves them. Cost: linear, some 25 ns per face; n log n for the boundaries.
  explicit HeightFields(const TriangleMesh& mesh);

  /// The field of a face; none if its region is not proved.
  RegionId field(FaceId face) const {
    const RegionId region = regions_.of_face[face];
    return is_field_[region] != 0 ? region : RegionId();
  }
  bool are_in_one(FaceId a, FaceId b) const {
    return regions_.of_face[a] == regions_.of_face[b] && is_field_[regions_.of_face[a]] != 0;
  }
  /// True if all faces at the vertex are in one field, and all their edges at the vertex are inside it.
  bool is_inside(VertexId vertex) const { return are_inside_[vertex.index()] != 0; }
  /// `is_inside` of all vertices, 0 or 1 each.
  const std::vector<std::uint8_t>& are_inside() const { return are_inside_; }

  /// All regions, proved or not.
  const FacingRegions& regions() const { return regions_; }
  /// The half-edges without an opposite in the same region.
  const std::vector<HalfedgeId>& borders() const { return borders_; }

 private:
  void find_borders(const TriangleMesh& mesh);
  void prove_regions(const TriangleMesh& mesh);
  void find_inner_vertices(const TriangleMesh& mesh);

  FacingRegions regions_;
  std::vector<HalfedgeId> borders_;            // ascending
  IdVector<RegionId, std::uint8_t> is_field_;  // 0 or 1
  std::vector<std::uint8_t> are_inside_;
};

}  // namespace algebra3d
