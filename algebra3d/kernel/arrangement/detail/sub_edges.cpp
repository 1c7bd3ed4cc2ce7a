#include "algebra3d/kernel/arrangement/detail/sub_edges.h"

#include <cstddef>
#include <numeric>

#include "algebra3d/kernel/exact/predicates.h"
#include "base/shrink.h"

namespace algebra3d::arrangement {
namespace {

/// A sub-edge in one facet by its second end, before those of one place are brought together.
struct FacetSubEdge {
  NodeId v;
  IncidentFacet incident;
};

/// The sub-edges in all facets by their first ends, with repetitions.
class FacetSubEdges {
 public:
  FacetSubEdges(const SegmentComplex& complex, const CutSegments& segments) : begins_(complex.nodes.size() + 1) {
    for_each(complex, segments, [&](NodeId u, const FacetSubEdge&) { ++begins_[u.index()]; });
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    parts_.assign(begins_.back(), {{}, {{}, {}}});
    for_each(complex, segments, [&](NodeId u, const FacetSubEdge& part) { parts_[--begins_[u.index()]] = part; });
  }

  std::size_t size() const { return parts_.size(); }
  /// The pieces with this first end, in no order.
  std::span<FacetSubEdge> from(NodeId u) {
    return std::span(parts_).subspan(begins_[u.index()], begins_[u.index() + std::size_t{1}] - begins_[u.index()]);
  }

 private:
  template <typename Visit>
  static void for_each(const SegmentComplex& complex, const CutSegments& segments, const Visit& visit) {
    for (const auto& [segment, facet, sides] : complex.incidences) {
      const auto nodes = segments.nodes(segment);
      for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        const NodeId from = nodes[i], to = nodes[i + 1];
        // No branch: which way a piece runs is unpredictable.
        const bool is_forward = from < to;
        visit(std::min(from, to), {std::max(from, to), {facet, is_forward ? sides : opposite(sides)}});
      }
    }
  }

  std::vector<std::uint32_t> begins_;  // of each first end, and where all end
  std::vector<FacetSubEdge> parts_;
};

/// Puts those of one first end together, place by place, into sub-edges.
class SubEdgeMaker {
 public:
  SubEdgeMaker(const Facets& facets, SubEdges& result) : facets_(facets), result_(result) {}

  void add(NodeId u, std::span<FacetSubEdge> parts) {
    std::ranges::sort(parts, [&](const FacetSubEdge& a, const FacetSubEdge& b) { return is_less(a, b); });
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const FacetSubEdge& part = parts[i];
      if (i == 0 || !are_at_one_place(parts[i - 1], part))
        add_sub_edge({u, part.v}, plane(part));
      else if (parts[i - 1].incident == part.incident)
        continue;
      // Sides are sorted with `both` first: a facet that is cut along its own boundary is on the side of that.
      if (part.incident.sides() == FacetSides::both && has_boundary(parts.subspan(i))) continue;
      result_.incident.push_back(part.incident);
    }
  }

 private:
  void add_sub_edge(const SpaceEdge& ends, PlaneId plane) {
    result_.ends.push_back(ends);
    result_.planes.push_back(plane);
    result_.first_incident.push_back(static_cast<std::uint32_t>(result_.incident.size()));
  }
  PlaneId plane(const FacetSubEdge& part) const { return facets_[part.incident.facet()].plane; }
  bool are_at_one_place(const FacetSubEdge& a, const FacetSubEdge& b) const {
    return a.v == b.v && plane(a) == plane(b);
  }
  bool is_less(const FacetSubEdge& a, const FacetSubEdge& b) const {
    if (a.v != b.v) return a.v < b.v;
    if (const PlaneId of_a = plane(a), of_b = plane(b); of_a != of_b) return of_a < of_b;
    return std::pair(a.incident.facet(), a.incident.sides()) < std::pair(b.incident.facet(), b.incident.sides());
  }
  /// True if the same facet follows with a side.
  static bool has_boundary(std::span<const FacetSubEdge> parts) {
    const auto& first = parts.front();
    const auto other = std::ranges::find_if(parts, [&](const FacetSubEdge& p) { return p.incident != first.incident; });
    return other != parts.end() && other->v == first.v && other->incident.facet() == first.incident.facet();
  }

  const Facets& facets_;
  SubEdges& result_;
};

}  // namespace

CutSegments::CutSegments(const SegmentComplex& complex) {
  slices_.reserve(complex.segments.size());
  nodes_.reserve(2 * complex.segments.size() + complex.cuts.size());
  auto cut = complex.cuts.begin();
  for (const SegmentId s : complex.segments.ids()) {
    const Segment& segment = complex.segments[s];
    const std::size_t first = nodes_.size();
    nodes_.push_back(segment.from);
    for (; cut != complex.cuts.end() && cut->segment == s; ++cut)
      if (cut->node != segment.from && cut->node != segment.to) nodes_.push_back(cut->node);
    nodes_.push_back(segment.to);
    slices_.push_back(Slice::from(first, nodes_));
    if (slices_.back().size() > 3) sort_along(complex, slices_.back());  // one cut is between the ends
  }
}

/// On a line, the lexicographic order is that along it.
void CutSegments::sort_along(const SegmentComplex& complex, const Slice& slice) {
  const auto begin = nodes_.begin() + slice.first, end = nodes_.begin() + slice.last;
  const NodeId from = *begin;
  const NodePool& nodes = complex.nodes;
  std::sort(begin, end, [&](NodeId a, NodeId b) { return std::is_lt(compare(nodes[a], nodes[b])); });
  if (*begin != from) std::reverse(begin, end);
}

SubEdges divide(const Facets& facets, SegmentComplex& complex) {
  SubEdges result;
  result.segments = CutSegments(complex);
  FacetSubEdges parts(complex, result.segments);
  complex.free_divided();
  result.ends.reserve(parts.size());
  result.planes.reserve(parts.size());
  result.first_incident.reserve(parts.size());
  result.incident.reserve(parts.size());
  SubEdgeMaker maker(facets, result);
  for (const NodeId u : complex.nodes.ids()) maker.add(u, parts.from(u));
  shrink(result.ends.values());
  shrink(result.planes.values());
  shrink(result.first_incident.values());
  shrink(result.incident);
  return result;
}

}  // namespace algebra3d::arrangement
