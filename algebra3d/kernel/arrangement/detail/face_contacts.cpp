#include "algebra3d/kernel/arrangement/detail/face_contacts.h"

#include <algorithm>
#include <utility>

namespace algebra3d::arrangement {
namespace {

/// True for a point that bounds both facets anyhow: whatever runs through it in either of them ends there.
bool is_corner_on_corner(const PairContact& pair, FacetBoundaries& boundaries) {
  const auto& [first, second, first_runs_along, second_runs_along] = pair.contact.points[0];
  return pair.contact.count == 1 && first.kind == Place::Kind::corner && second.kind == Place::Kind::corner &&
         boundaries.has_origin(Operands::halfedge(pair.first_face, first.index)) &&
         boundaries.has_origin(Operands::halfedge(pair.second_face, second.index));
}

Feature feature_at(InputFaceId face, const Place& place, const Operands& operands, const Facets& facets) {
  const InputHalfedgeId halfedge = Operands::halfedge(face, place.index);
  switch (place.kind) {
    case Place::Kind::corner:
      return Feature(operands.origin(halfedge));
    case Place::Kind::edge:
      return Feature(operands.edge(halfedge));
    default:
      return Feature(facets.of_face[face]);
  }
}

InputHalfedgeId halfedge_along(InputFaceId face, std::uint8_t edge) {
  return edge == TriangleContact::kNoEdge ? InputHalfedgeId::none() : Operands::halfedge(face, edge);
}

}  // namespace

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

std::optional<FaceContact> face_contact(const PairContact& pair, const Operands& operands, const Facets& facets,
                                        FacetBoundaries& boundaries) {
  const auto& [first_face, second_face, contact] = pair;
  if (contact.is_coplanar || is_corner_on_corner(pair, boundaries)) return std::nullopt;
  FaceContact result{facets.of_face[first_face],
                     facets.of_face[second_face],
                     {},
                     halfedge_along(first_face, contact.first_edge),
                     halfedge_along(second_face, contact.second_edge)};
  for (std::size_t end = 0; end < 2; ++end) {
    const ContactPoint& point = contact.points[contact.count == 2 ? end : 0];
    result.ends[end] = {{feature_at(first_face, point.first, operands, facets),
                         feature_at(second_face, point.second, operands, facets)},
                        {Operands::halfedge(first_face, point.first.index), point.first_runs_along},
                        {Operands::halfedge(second_face, point.second.index), point.second_runs_along}};
  }
  if (result.ends[1].features < result.ends[0].features) std::swap(result.ends[0], result.ends[1]);
  return result;
}

}  // namespace algebra3d::arrangement
