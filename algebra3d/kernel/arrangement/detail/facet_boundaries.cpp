#include "algebra3d/kernel/arrangement/detail/facet_boundaries.h"

#include <algorithm>

namespace algebra3d::arrangement {

bool FacetBoundaries::has_origin(InputHalfedgeId halfedge) {
  if (origins_.empty()) origins_.resize(operands_.halfedge_count());
  Known& known = origins_[halfedge];
  if (known == Known::nothing) known = finds_boundary_at_origin(halfedge) ? Known::boundary : Known::inside;
  return known == Known::boundary;
}

bool FacetBoundaries::finds_boundary_at_origin(InputHalfedgeId halfedge) const {
  std::vector<InputHalfedgeId> outgoing;
  operands_.halfedges_around_origin(halfedge, outgoing);
  const FacetId facet = facets_.of_face[Operands::face(halfedge)];
  return std::ranges::any_of(outgoing, [&](InputHalfedgeId h) {
    return facets_.of_face[Operands::face(h)] != facet || has_edge(h) || has_edge(Operands::previous(h));
  });
}

}  // namespace algebra3d::arrangement
