#include <algorithm>
#include <utility>

#include "algebra3d/kernel/arrangement/detail/id_tree.h"
#include "algebra3d/kernel/arrangement/detail/stage_audit.h"
#include "algebra3d/kernel/arrangement/detail/sub_edges.h"

namespace algebra3d::arrangement {
namespace {

class SubEdgesAudit {
 public:
  SubEdgesAudit(const Facets& facets, const SegmentComplex& complex, const SubEdges& sub_edges)
      : facets_(facets), nodes_(complex.nodes), complex_(complex), sub_edges_(sub_edges) {}

  std::vector<std::string> run();

 private:
  bool check_lists();
  void check_order();
  void check_incident_facets(SubEdgeId id);
  void check_crossings();
  void check_pair(SubEdgeId a, SubEdgeId b);
  void check_cut_segments();
  bool is_in_plane(NodeId node, PlaneId plane) const {
    const TriangleRef triangle = facets_.planes[plane].triangle();
    return orient3d(triangle[0], triangle[1], triangle[2], nodes_[node]) == 0;
  }

  const Facets& facets_;
  const NodePool& nodes_;
  const SegmentComplex& complex_;
  const SubEdges& sub_edges_;
  Violations violations_;
};

/// Whether all ids are those of something.
bool SubEdgesAudit::check_lists() {
  bool holds = true;
  std::size_t first = 0;
  for (const SubEdgeId id : sub_edges_.ids()) {
    const auto [ends, plane] = sub_edges_[id];
    const std::size_t begin = sub_edges_.first_incident[id], end = sub_edges_.end_of_incident(id);
    holds &=
        violations_.expect(ends.u < ends.v && ends.v.index() < nodes_.size() && plane.index() < facets_.planes.size(),
                           "sub-edge {} has no two ends, ascending, or no plane", id.index());
    holds &= violations_.expect(begin == first && end > first && end <= sub_edges_.incident.size(),
                                "sub-edge {} has the incident facets {} to {} of {}", id.index(), begin, end,
                                sub_edges_.incident.size());
    first = end;
  }
  for (const IncidentFacet& incident : sub_edges_.incident)
    holds &= violations_.expect(incident.facet().index() < facets_.facets.size(), "an incident facet is not there");
  return holds;
}

void SubEdgesAudit::check_order() {
  const auto key = [&](SubEdgeId id) { return std::pair(sub_edges_[id].ends, sub_edges_[id].plane); };
  for (std::size_t i = 1; i < sub_edges_.size(); ++i)
    violations_.expect(key(SubEdgeId(i - 1)) < key(SubEdgeId(i)), "sub-edge {} is not behind the one before it", i);
}

void SubEdgesAudit::check_incident_facets(SubEdgeId id) {
  const auto [ends, plane] = sub_edges_[id];
  violations_.expect(is_in_plane(ends.u, plane) && is_in_plane(ends.v, plane), "sub-edge {} is not in its plane {}",
                     id.index(), plane.index());
  const auto incident = sub_edges_.incident_to(id);
  for (const IncidentFacet& at : incident) {
    const FacetId facet = at.facet();
    violations_.expect(facets_[facet].plane == plane, "sub-edge {}: facet {} is in another plane", id.index(),
                       facet.index());
    // A facet may have the line for a boundary twice, once from each side.
    const auto is_same = [&](const IncidentFacet& f) {
      return f.facet() == facet &&
             std::ranges::any_of(kSides, [&](Side s) { return includes(f.sides(), s) && includes(at.sides(), s); });
    };
    violations_.expect(std::ranges::count_if(incident, is_same) == 1, "sub-edge {}: facet {} is on one side twice",
                       id.index(), facet.index());
  }
}

/// Sub-edges of one plane meet in common ends alone.
void SubEdgesAudit::check_pair(SubEdgeId a, SubEdgeId b) {
  if (sub_edges_[a].plane != sub_edges_[b].plane) return;
  const SpaceEdge s = sub_edges_[a].ends, t = sub_edges_[b].ends;
  const Contact found = intersect_segments(nodes_[s.u], nodes_[s.v], nodes_[t.u], nodes_[t.v]);
  const bool have_common_end = s.u == t.u || s.u == t.v || s.v == t.u || s.v == t.v;
  violations_.expect(found == Contact::none || (found == Contact::point && have_common_end),
                     "sub-edges {} and {} meet in more than ends", a.index(), b.index());
}

void SubEdgesAudit::check_crossings() {
  IdTree<SubEdgeId>::Boxes boxes;
  for (const SubEdgeId id : sub_edges_.ids()) {
    Box3 box = box_of(nodes_[sub_edges_[id].ends.u]);
    box.extend(box_of(nodes_[sub_edges_[id].ends.v]));
    boxes.add(box, id);
  }
  boxes.tree().for_each_pair([&](SubEdgeId a, SubEdgeId b) {
    check_pair(a, b);
    return true;
  });
}

/// The nodes of each segment lead from its one end to the other, straight on.
void SubEdgesAudit::check_cut_segments() {
  if (!violations_.expect(sub_edges_.segments.size() == complex_.segments.size(), "{} segments are cut, not {}",
                          sub_edges_.segments.size(), complex_.segments.size()))
    return;
  for (const SegmentId id : complex_.segments.ids()) {
    const auto along = sub_edges_.segments.nodes(id);
    const Segment& segment = complex_.segments[id];
    violations_.expect(along.front() == segment.from && along.back() == segment.to,
                       "segment {} has other ends once it is cut", id.index());
    for (std::size_t i = 1; i + 1 < along.size(); ++i)
      violations_.expect(
          compare(nodes_[along[i - 1]], nodes_[along[i]]) == compare(nodes_[along[i]], nodes_[along[i + 1]]),
          "segment {}: node {} is not between its neighbours", id.index(), along[i].index());
  }
}

std::vector<std::string> SubEdgesAudit::run() {
  if (!check_lists()) return violations_.take();
  check_order();
  for (const SubEdgeId id : sub_edges_.ids()) check_incident_facets(id);
  check_crossings();
  check_cut_segments();
  return violations_.take();
}

}  // namespace

std::vector<std::string> audit(const Facets& facets, const SegmentComplex& complex, const SubEdges& sub_edges) {
  return SubEdgesAudit(facets, complex, sub_edges).run();
}

}  // namespace algebra3d::arrangement
