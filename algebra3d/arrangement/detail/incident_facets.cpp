#include "algebra3d/arrangement/detail/incident_facets.h"

#include <algorithm>

#include "algebra3d/arrangement/detail/contact.h"
#include "algebra3d/arrangement/detail/id_tree.h"
#include "algebra3d/halfedge/boxes.h"

namespace algebra3d::arrangement {
namespace {

using FaceTrees = IdVector<PlaneId, IdTree<InputFaceId>>;

/// The faces of all facets of each plane that has sub-edges.
FaceTrees trees_of_planes(const Operands& operands, const Facets& facets, const SubEdges& sub_edges) {
  IdVector<PlaneId, bool> is_wanted(facets.planes.size());
  for (const PlaneId plane : sub_edges.planes) is_wanted[plane] = true;
  IdVector<PlaneId, IdTree<InputFaceId>::Boxes> boxes(facets.planes.size());
  for (const Facet& facet : facets.facets)
    if (is_wanted[facet.plane])
      for (const InputFaceId face : facet.faces.of(facets.faces))
        boxes[facet.plane].add(box_of_triangle(operands.corners(face)), face);
  FaceTrees trees;
  trees.reserve(boxes.size());
  for (const auto& of_plane : boxes) trees.push_back(of_plane.tree());
  return trees;
}

/// Appends the facets that hold the middle of a sub-edge and are not among those from `first` on.
void add_missing(const Operands& operands, const Facets& facets, const ExactPoint& middle,
                 const IdTree<InputFaceId>& faces, std::size_t first, std::vector<IncidentFacet>& incident) {
  faces.for_each_in(box_of(middle), [&](InputFaceId face) {
    const FacetId facet = facets.of_face[face];
    const auto own = std::span(incident).subspan(first);
    if (std::ranges::find(own, facet, &IncidentFacet::facet) != own.end()) return;
    // Not on the facet's boundary, along which the facet would be incident already: inside.
    if (TriangleInPlane(operands.corners(face)).place(middle)) incident.emplace_back(facet, FacetSides::both);
  });
}

}  // namespace

Result<SubEdges> with_all_incident_facets(const Operands& operands, const Facets& facets, const SegmentComplex& complex,
                                          SubEdges sub_edges, const Monitor& monitor) {
  const FaceTrees trees = trees_of_planes(operands, facets, sub_edges);
  std::vector<IncidentFacet> incident;
  incident.reserve(sub_edges.incident.size());
  Stage stage(monitor.silent(), {}, sub_edges.size());
  for (const SubEdgeId id : sub_edges.ids()) {
    if (!stage.begin_step()) return Monitor::interrupted();
    const auto [ends, plane] = sub_edges[id];
    const auto given = sub_edges.incident_to(id);
    const std::size_t first = incident.size();
    incident.insert(incident.end(), given.begin(), given.end());
    add_missing(operands, facets, complex.nodes.middle(ends.u, ends.v), trees[plane], first, incident);
    sub_edges.first_incident[id] = static_cast<std::uint32_t>(first);
  }
  sub_edges.incident = std::move(incident);
  return sub_edges;
}

}  // namespace algebra3d::arrangement
