#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/segment_complex.h"
#include "algebra3d/kernel/arrangement/detail/slice.h"
#include "base/equal_span.h"

namespace algebra3d::arrangement {

/// The nodes along each segment, from one end over all cuts to the other end.
class CutSegments {
 public:
  CutSegments() = default;
  /// The cuts of the complex must be sorted, as overlay leaves them. Cost: near-linear.
  explicit CutSegments(const SegmentComplex& complex);

  std::size_t size() const { return slices_.size(); }
  std::span<const NodeId> nodes(SegmentId segment) const { return slices_[segment].of(nodes_); }

 private:
  void sort_along(const SegmentComplex& complex, const Slice& slice);

  IdVector<SegmentId, Slice> slices_;
  std::vector<NodeId> nodes_;
};

/// An incident facet of a sub-edge: a facet of its plane that holds it, on both sides of it or on one, seen from the
/// front of the plane by someone who walks from u to v.
class IncidentFacet {
 public:
  IncidentFacet(FacetId facet, FacetSides sides)
      : facet_and_sides_(facet.index() << 2U | static_cast<std::uint32_t>(sides)) {}

  FacetId facet() const { return FacetId(facet_and_sides_ >> 2U); }
  FacetSides sides() const { return static_cast<FacetSides>(facet_and_sides_ & 3U); }

  friend bool operator==(const IncidentFacet&, const IncidentFacet&) = default;

 private:
  std::uint32_t facet_and_sides_;  // there are fewer than 2^30 faces (TriangleMesh::kMaxFaces), and so facets
};

/// An undivided piece of a segment in space, by its two nodes, u < v. It is one sub-edge in each plane in which it
/// lies.
struct SpaceEdge {
  NodeId u, v;

  static SpaceEdge of(NodeId a, NodeId b) { return {std::min(a, b), std::max(a, b)}; }
  /// Both nodes in one number, in which they are compared: that is what sorting and searching spend their time on.
  std::uint64_t key() const { return std::uint64_t{u.index()} << 32U | v.index(); }

  friend bool operator==(const SpaceEdge& a, const SpaceEdge& b) { return a.key() == b.key(); }
  friend auto operator<=>(const SpaceEdge& a, const SpaceEdge& b) { return a.key() <=> b.key(); }
};

/// An undivided piece of a segment, in one plane: no other sub-edge of the plane crosses it. To its left and right lie
/// two sub-facets: parts of the plane that no sub-edge divides, covered by facets or not.
struct SubEdge {
  SpaceEdge ends;
  PlaneId plane;
};

/// Output of stage 6: the subdivision of all planes. Separate lists for the members of a sub-edge find room more
/// easily, where there are many.
struct SubEdges {
  /// Ascending, and those along one space edge ascending by plane: so these are neighbours.
  IdVector<SubEdgeId, SpaceEdge> ends;
  IdVector<SubEdgeId, PlaneId> planes;
  IdVector<SubEdgeId, std::uint32_t> first_incident;  ///< of `incident`; those of the next sub-edge follow
  /// Sub-edge by sub-edge. The list of each is complete if all operands are closed: a sub-edge of plane P lies on a
  /// facet G that is not in P, a neighbour across a boundary edge or a facet that crosses P. A facet of P of another
  /// operand that holds the sub-edge meets G there, so stage 4 has found it as a contact; one of the same operand has
  /// the sub-edge in its boundary, which stage 4 adds.
  std::vector<IncidentFacet> incident;
  CutSegments segments;  ///< the nodes along each segment; freed once uncut edges are known

  std::size_t size() const { return ends.size(); }
  IdRange<SubEdgeId> ids() const { return ends.ids(); }
  IdRange<SubEdgeSide> sides() const { return IdRange<SubEdgeSide>(2 * size()); }
  SubEdge operator[](SubEdgeId sub_edge) const { return {ends[sub_edge], planes[sub_edge]}; }
  /// Where those of `incident` end that are incident to a sub-edge.
  std::size_t end_of_incident(SubEdgeId sub_edge) const {
    const std::size_t next = sub_edge.index() + std::size_t{1};
    return next < size() ? first_incident[SubEdgeId(next)] : incident.size();
  }
  /// The incident facets of a sub-edge.
  std::span<const IncidentFacet> incident_to(SubEdgeId sub_edge) const {
    const std::size_t first = first_incident[sub_edge];
    return std::span(incident).subspan(first, end_of_incident(sub_edge) - first);
  }
  /// True if a facet covers the sub-facet at that side.
  bool is_covered(SubEdgeSide side) const {
    return std::ranges::any_of(incident_to(side.sub_edge()),
                               [&](const IncidentFacet& f) { return includes(f.sides(), side.side()); });
  }
  /// The sub-edges along a space edge, one for each plane.
  IdRange<SubEdgeId> along(const SpaceEdge& edge) const {
    const auto found = equal_span(ends.values(), edge);
    const auto first = static_cast<std::size_t>(found.data() - ends.values().data());
    return {SubEdgeId(first), SubEdgeId(first + found.size())};
  }
  /// The sub-edges along the same space edge as one of them.
  IdRange<SubEdgeId> beside(SubEdgeId sub_edge) const {
    SubEdgeId first = sub_edge, last(sub_edge.index() + 1);
    while (first.index() > 0 && ends[SubEdgeId(first.index() - 1)] == ends[sub_edge])
      first = SubEdgeId(first.index() - 1);
    while (last < ends.next_id() && ends[last] == ends[sub_edge]) last = SubEdgeId(last.index() + 1);
    return {first, last};
  }
  /// Calls visit(sub_edges) for the sub-edges along each space edge.
  template <typename Visit>
  void for_each_space_edge(const Visit& visit) const {
    for_each_space_edge(ids(), visit);
  }
  /// Calls visit(sub_edges) for each space edge whose first sub-edge is in a range.
  template <typename Visit>
  void for_each_space_edge(IdRange<SubEdgeId> range, const Visit& visit) const {
    const auto end_of = [&](SubEdgeId last) {
      do {
        last = SubEdgeId(last.index() + 1);
      } while (last < ends.next_id() && ends[last] == ends[SubEdgeId(last.index() - 1)]);
      return last;
    };
    SubEdgeId first = *range.begin();
    const SubEdgeId end = *range.end();
    if (first < end && first.index() > 0 && ends[first] == ends[SubEdgeId(first.index() - 1)]) first = end_of(first);
    for (SubEdgeId last; first < end; first = last) {
      last = end_of(first);
      visit(IdRange(first, last));
    }
  }
};

/// Stage 6: divides at their cuts the segments of a complex that overlay has completed. Equal pieces of several
/// segments become one sub-edge in each plane, with the incident facets of all. If a facet has both an incidence with
/// FacetSides::both and, from its boundary, one with a side, the latter counts. Leaves the complex without incidences,
/// cuts, touches and collinear segments. Cost: n log n.
SubEdges divide(const Facets& facets, SegmentComplex& complex);

/// Every violated invariant, one sentence each: sub-edges are ascending and lie in their planes, which are those of
/// their incident facets; a facet is on a side at most once; sub-edges of one plane meet in common ends alone; each cut
/// segment leads straight on from one end to the other. Cost: n log n, with exact predicates.
std::vector<std::string> audit(const Facets& facets, const SegmentComplex& complex, const SubEdges& sub_edges);

}  // namespace algebra3d::arrangement
