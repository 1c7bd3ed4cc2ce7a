#include <algorithm>
#include <compare>
#include <tuple>

#include "algebra3d/kernel/arrangement/detail/segment_complex.h"
#include "algebra3d/kernel/arrangement/detail/stage_audit.h"

namespace algebra3d::arrangement {
namespace {

class SegmentComplexAudit {
 public:
  SegmentComplexAudit(const Operands& operands, const Facets& facets, const SegmentComplex& complex)
      : operands_(operands), facets_(facets), complex_(complex), nodes_(complex.nodes) {}

  std::vector<std::string> run();

 private:
  bool is(NodeId node) const { return node.index() < nodes_.size(); }
  bool is(SegmentId segment) const { return segment.index() < complex_.segments.size(); }
  bool is(FacetId facet) const { return facet.index() < facets_.facets.size(); }
  bool check_ids();
  void check_segment(SegmentId id);
  void check_edge(SegmentId id);
  void check_distinct_segments();
  void check_incidence(const SegmentIncidence& incidence);
  void check_cut(const Cut& cut);
  void check_collinear(const CollinearSegments& pair);
  void check_nodes_of_vertices();
  bool is_in_plane(NodeId node, FacetId facet) const;
  bool is_collinear(const Segment& segment, NodeId node) const {
    return collinear(nodes_[segment.from], nodes_[segment.to], nodes_[node]);
  }

  const Operands& operands_;
  const Facets& facets_;
  const SegmentComplex& complex_;
  const NodePool& nodes_;
  Violations violations_;
};

/// Whether all ids are those of something.
bool SegmentComplexAudit::check_ids() {
  const auto all = [&](const char* what, const auto& list, const auto& is_known) {
    std::size_t i = 0;
    bool holds = true;
    for (const auto& element : list)
      holds &= violations_.expect(is_known(element), "{} {} names what is not there", what, i++);
    return holds;
  };
  return all("segment", complex_.segments, [&](const Segment& s) { return is(s.from) && is(s.to); }) &&
         all("incidence", complex_.incidences,
             [&](const SegmentIncidence& i) { return is(i.segment) && is(i.facet); }) &&
         all("cut", complex_.cuts, [&](const Cut& c) { return is(c.segment) && is(c.node); }) &&
         all("touch", complex_.touches, [&](const Touch& t) { return is(t.facet) && is(t.node); }) &&
         all("pair of collinear segments", complex_.collinear,
             [&](const CollinearSegments& pair) { return is(pair.first) && is(pair.second); }) &&
         all("vertex that is a node", complex_.nodes_of_vertices,
             [&](const NodeOfVertex& v) { return v.vertex.index() < operands_.vertex_count() && is(v.node); });
}

void SegmentComplexAudit::check_segment(SegmentId id) {
  const Segment& segment = complex_.segments[id];
  if (!violations_.expect(segment.from != segment.to, "segment {} is a point", id.index())) return;
  violations_.expect(segment.first_facet.is_none() == segment.second_facet.is_none(),
                     "segment {} is a common part of one facet", id.index());
  violations_.expect(!segment.edge.is_none() || !segment.first_facet.is_none(),
                     "segment {} is neither an edge nor a common part", id.index());
  if (!segment.edge.is_none()) check_edge(id);
}

/// A segment may run along several edges, in either direction.
void SegmentComplexAudit::check_edge(SegmentId id) {
  const Segment& segment = complex_.segments[id];
  const InputHalfedgeId halfedge = Operands::halfedge(segment.edge);
  const PointRef start = operands_.point(halfedge), end = operands_.point(Operands::next(halfedge));
  const PointRef from = nodes_[segment.from], to = nodes_[segment.to];
  violations_.expect((equal(start, from) && equal(end, to)) || (equal(start, to) && equal(end, from)),
                     "segment {} has other ends than its edge {}", id.index(), segment.edge.index());
}

void SegmentComplexAudit::check_distinct_segments() {
  std::vector<std::tuple<NodeId, NodeId, SegmentId>> sorted;
  for (const SegmentId id : complex_.segments.ids()) {
    const auto [lower, higher] = std::minmax(complex_.segments[id].from, complex_.segments[id].to);
    sorted.emplace_back(lower, higher, id);
  }
  std::ranges::sort(sorted);
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const auto& [from, to, id] = sorted[i];
    const auto& [from_before, to_before, before] = sorted[i - 1];
    violations_.expect(from != from_before || to != to_before, "segments {} and {} are between the same nodes",
                       before.index(), id.index());
  }
}

bool SegmentComplexAudit::is_in_plane(NodeId node, FacetId facet) const {
  const TriangleRef plane = facets_.plane_of(facet).triangle();
  return orient3d(plane[0], plane[1], plane[2], nodes_[node]) == 0;
}

void SegmentComplexAudit::check_incidence(const SegmentIncidence& incidence) {
  const Segment& segment = complex_.segments[incidence.segment];
  violations_.expect(is_in_plane(segment.from, incidence.facet) && is_in_plane(segment.to, incidence.facet),
                     "segment {} is not in the plane of its facet {}", incidence.segment.index(),
                     incidence.facet.index());
  violations_.expect(incidence.sides == FacetSides::both || !segment.edge.is_none(),
                     "segment {} bounds facet {}, but is not an edge", incidence.segment.index(),
                     incidence.facet.index());
}

/// A cut lies between the ends of its segment, or is one of them.
void SegmentComplexAudit::check_cut(const Cut& cut) {
  const Segment& segment = complex_.segments[cut.segment];
  if (cut.node == segment.from || cut.node == segment.to) return;
  const PointRef from = nodes_[segment.from], at = nodes_[cut.node], to = nodes_[segment.to];
  violations_.expect(is_collinear(segment, cut.node) && compare(from, at) == compare(at, to),
                     "segment {} is cut at node {}, which is not on it", cut.segment.index(), cut.node.index());
}

void SegmentComplexAudit::check_collinear(const CollinearSegments& pair) {
  const Segment &first = complex_.segments[pair.first], &second = complex_.segments[pair.second];
  violations_.expect(is_collinear(first, second.from) && is_collinear(first, second.to),
                     "segments {} and {} are not on one line", pair.first.index(), pair.second.index());
}

void SegmentComplexAudit::check_nodes_of_vertices() {
  IdVector<InputVertexId, bool> is_seen(operands_.vertex_count());
  for (const auto& [vertex, node] : complex_.nodes_of_vertices) {
    const OperandId operand = operands_.operand_of(vertex);
    const PointRef point = operands_.mesh(operand).point(operands_.in_mesh(operand, vertex));
    violations_.expect(equal(point, nodes_[node]), "vertex {} is not at its node {}", vertex.index(), node.index());
    violations_.expect(!is_seen[vertex], "vertex {} has two nodes", vertex.index());
    is_seen[vertex] = true;
  }
}

std::vector<std::string> SegmentComplexAudit::run() {
  if (!check_ids()) return violations_.take();
  for (const SegmentId segment : complex_.segments.ids()) check_segment(segment);
  check_distinct_segments();
  for (const SegmentIncidence& incidence : complex_.incidences) check_incidence(incidence);
  for (const Cut& cut : complex_.cuts) check_cut(cut);
  for (const auto& [facet, node] : complex_.touches)
    violations_.expect(is_in_plane(node, facet), "node {} touches facet {} outside of its plane", node.index(),
                       facet.index());
  for (const CollinearSegments& pair : complex_.collinear) check_collinear(pair);
  check_nodes_of_vertices();
  return violations_.take();
}

}  // namespace

std::vector<std::string> audit(const Operands& operands, const Facets& facets, const SegmentComplex& complex) {
  return SegmentComplexAudit(operands, facets, complex).run();
}

}  // namespace algebra3d::arrangement
