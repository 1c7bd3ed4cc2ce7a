#include "algebra3d/kernel/arrangement/detail/incident_facets.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include "algebra3d/kernel/arrangement/detail/contact.h"
#include "algebra3d/kernel/arrangement/detail/id_tree.h"
#include "algebra3d/kernel/search/boxes.h"

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

/// The middle of a sub-edge, which is computed if it must be: fractions of nearly coincident facets have hundreds of
/// digits.
class Middle {
 public:
  Middle(const NodePool& nodes, const SubEdge& edge) : nodes_(nodes), u_(edge.ends.u), v_(edge.ends.v) {}

  /// A box around it.
  Box3 box() const {
    const Box3 u = box_of(nodes_[u_]), v = box_of(nodes_[v_]);
    Box3 result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.min[axis] = below(u.min[axis] / 2 + v.min[axis] / 2);
      result.max[axis] = -below(-(u.max[axis] / 2 + v.max[axis] / 2));
    }
    return result;
  }

  /// True if it lies in a closed triangle of its plane. Exact. Ends on one side of an edge decide it without the
  /// middle.
  bool lies_in(const TriangleInPlane& triangle) {
    bool is_known = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const int u = triangle.side_of_edge(i, nodes_[u_]), v = triangle.side_of_edge(i, nodes_[v_]);
      if (u + v < 0) return false;
      is_known = is_known && u * v >= 0;
    }
    if (is_known) return true;
    if (!point_) point_ = nodes_.middle(u_, v_);
    return triangle.place(*point_).has_value();
  }

 private:
  /// Two steps down: halves may be rounded where they are no longer normal, and so is the sum.
  static double below(double x) {
    constexpr double kLowest = -std::numeric_limits<double>::infinity();
    return std::nextafter(std::nextafter(x, kLowest), kLowest);
  }

  const NodePool& nodes_;
  NodeId u_, v_;
  std::optional<ExactPoint> point_;
};

/// Appends the facets that hold the middle of a sub-edge and are not among those from `first` on.
void add_missing(const Operands& operands, const Facets& facets, Middle middle, const IdTree<InputFaceId>& faces,
                 std::size_t first, std::vector<IncidentFacet>& incident) {
  faces.for_each_in(middle.box(), [&](InputFaceId face) {
    const FacetId facet = facets.of_face[face];
    const auto own = std::span(incident).subspan(first);
    if (std::ranges::find(own, facet, &IncidentFacet::facet) != own.end()) return;
    // Not on the facet's boundary, along which the facet would be incident already: inside.
    if (middle.lies_in(TriangleInPlane(operands.corners(face)))) incident.emplace_back(facet, FacetSides::both);
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
    const SubEdge edge = sub_edges[id];
    const auto given = sub_edges.incident_to(id);
    const std::size_t first = incident.size();
    incident.insert(incident.end(), given.begin(), given.end());
    add_missing(operands, facets, Middle(complex.nodes, edge), trees[edge.plane], first, incident);
    sub_edges.first_incident[id] = static_cast<std::uint32_t>(first);
  }
  sub_edges.incident = std::move(incident);
  return sub_edges;
}

}  // namespace algebra3d::arrangement
