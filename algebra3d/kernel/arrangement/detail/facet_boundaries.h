#pragma once

#include "algebra3d/kernel/arrangement/detail/facets.h"

namespace algebra3d::arrangement {

/// Queries about the boundaries of facets: whether edges and vertices of faces are on them.
class FacetBoundaries {
 public:
  FacetBoundaries(const Operands& operands, const Facets& facets) : operands_(operands), facets_(facets) {}

  /// True unless the faces on both sides of the edge are of one facet. The half-edge's face must be in a facet.
  bool has_edge(InputHalfedgeId halfedge) const { return facets_.is_boundary(operands_, halfedge); }
  /// True if the origin of the half-edge is on the boundary of the facet of its face, false if it is inside that facet.
  /// The face must be in a facet.
  bool has_origin(InputHalfedgeId halfedge);

 private:
  enum class Known : std::uint8_t { nothing, inside, boundary };

  bool finds_boundary_at_origin(InputHalfedgeId halfedge) const;

  const Operands& operands_;
  const Facets& facets_;
  IdVector<InputHalfedgeId, Known> origins_;  // empty until one is asked for: solids in general position ask for none
};

}  // namespace algebra3d::arrangement
