#pragma once

#include <span>
#include <vector>

#include "algebra3d/base/strong_id.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "base/id_vector.h"

namespace algebra3d {

/// A coplanar facet of a mesh.
using CoplanarFacetId = StrongId<struct CoplanarFacetTag>;

/// The coplanar facets of one mesh: maximal sets of faces that lie in one plane and are connected across manifold
/// edges. Like the facets that detail/facets.h makes of the operands of an arrangement, for the rounding of one mesh
/// (rounding/detail/facet_outlines.h, coplanar_snapping.h). Immutable.
class CoplanarFacets {
 public:
  /// The mesh must outlive this. Exact. Cost: linear.
  explicit CoplanarFacets(const TriangleMesh& mesh);

  IdRange<CoplanarFacetId> ids() const { return facets_.ids(); }
  CoplanarFacetId of(FaceId face) const { return of_face_[face]; }
  /// The faces of a facet, in an order that depends on the mesh only.
  std::span<const FaceId> faces(CoplanarFacetId facet) const {
    return std::span(faces_).subspan(facets_[facet].first, facets_[facet].count);
  }
  /// True unless the faces on both sides of the edge are in the same facet.
  bool is_boundary(HalfedgeId h) const {
    const HalfedgeId other = mesh_->opposite(h);
    return !other.is_valid() || of(TriangleMesh::face(other)) != of(TriangleMesh::face(h));
  }
  /// The projection along the axis nearest to the facet's normal.
  Projection projection(CoplanarFacetId facet) const { return facets_[facet].projection; }
  /// True if the facet's front is seen clockwise in the projection.
  bool is_flipped(CoplanarFacetId facet) const { return facets_[facet].is_flipped; }

 private:
  struct Facet {
    std::size_t first, count;  // of faces_
    Projection projection;
    bool is_flipped;
  };

  const TriangleMesh* mesh_;
  IdVector<FaceId, CoplanarFacetId> of_face_;
  IdVector<CoplanarFacetId, Facet> facets_;
  std::vector<FaceId> faces_;  // facet by facet
};

}  // namespace algebra3d
