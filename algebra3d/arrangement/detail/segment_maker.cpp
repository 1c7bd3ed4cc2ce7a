#include "algebra3d/arrangement/detail/segment_maker.h"

#include <algorithm>

namespace algebra3d::arrangement {

NodeId SegmentMaker::node_at_origin(InputHalfedgeId halfedge) {
  const InputVertexId vertex = operands_.origin(halfedge);
  const auto [entry, is_new] = nodes_of_vertices_.try_emplace(vertex);
  if (is_new) {
    entry->second = complex_.nodes.intern(operands_.point(halfedge));
    complex_.nodes_of_vertices.push_back({vertex, entry->second});
  }
  return entry->second;
}

SegmentId SegmentMaker::between(NodeId from, NodeId to) {
  const auto [entry, is_new] = between_.try_emplace({std::min(from, to), std::max(from, to)});
  if (is_new) entry->second = complex_.segments.push_back({from, to, {}, {}, {}});
  return entry->second;
}

SegmentId SegmentMaker::of_edge(InputEdgeId edge) {
  const auto [entry, is_new] = of_edges_.try_emplace(edge);
  if (is_new) {
    const InputHalfedgeId halfedge = Operands::halfedge(edge);
    entry->second = between(node_at_origin(halfedge), node_at_origin(Operands::next(halfedge)));
    complex_.segments[entry->second].edge = edge;
  }
  return entry->second;
}

SegmentId SegmentMaker::of_contact(NodeId from, NodeId to, FacetId facet, FacetId other) {
  const SegmentId id = between(from, to);
  Segment& segment = complex_.segments[id];
  if (segment.first_facet.is_none()) {
    segment.first_facet = facet;
    segment.second_facet = other;
  }
  complex_.incidences.push_back({id, facet, FacetSides::both});
  complex_.incidences.push_back({id, other, FacetSides::both});
  return id;
}

void SegmentMaker::add_boundary(FacetId facet, InputHalfedgeId halfedge) {
  const SegmentId segment = of_edge(operands_.edge(halfedge));
  // The facet lies to the left of its half-edge, seen from its own front.
  const bool runs_along = node_at_origin(halfedge) == complex_.segments[segment].from;
  const bool is_left = runs_along == (facets_[facet].orientation > 0);
  complex_.incidences.push_back({segment, facet, is_left ? FacetSides::left : FacetSides::right});
}

void SegmentMaker::add_boundaries() {
  for (const FacetId facet : facets_.ids())
    for (const InputFaceId face : facets_.faces_of(facet))
      for (const InputHalfedgeId h : Operands::halfedges(face))
        if (facets_.is_boundary(operands_, h)) add_boundary(facet, h);
}

}  // namespace algebra3d::arrangement
