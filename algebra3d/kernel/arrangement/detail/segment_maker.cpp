#include "algebra3d/kernel/arrangement/detail/segment_maker.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace algebra3d::arrangement {

NodeId SegmentMaker::node_at_origin(InputHalfedgeId halfedge) {
  const InputVertexId vertex = operands_.origin(halfedge);
  NodeId& node = nodes_of_vertices_[vertex.index()];
  if (node.is_none()) {
    node = complex_.nodes.intern(operands_.point(halfedge));
    complex_.nodes_of_vertices.push_back({vertex, node});
  }
  return node;
}

SegmentId SegmentMaker::between(NodeId from, NodeId to) {
  SegmentId& segment = between_[std::uint64_t{std::min(from, to).index()} << 32U | std::max(from, to).index()];
  if (segment.is_none()) segment = complex_.segments.push_back({from, to, {}, {}, {}});
  return segment;
}

SegmentId SegmentMaker::of_edge(InputEdgeId edge) {
  CornerNodes nodes;
  return of_edge_along(edge, Operands::halfedge(edge), nodes);
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

NodeId SegmentMaker::node_at(InputHalfedgeId corner, CornerNodes& nodes) {
  NodeId& node = nodes[corner.index() % 3];
  if (node.is_none()) node = node_at_origin(corner);
  return node;
}

/// As of_edge, with a half-edge along it and what is known of the corners of its face.
SegmentId SegmentMaker::of_edge_along(InputEdgeId edge, InputHalfedgeId halfedge, CornerNodes& nodes) {
  SegmentId& segment = of_edges_[edge.index()];
  if (!segment.is_none()) return segment;
  InputHalfedgeId from = halfedge, to = Operands::next(halfedge);
  if (operands_.origin(Operands::halfedge(edge)) != operands_.origin(halfedge)) std::swap(from, to);
  const NodeId end = node_at(to, nodes), begin = node_at(from, nodes);
  segment = between(begin, end);
  complex_.segments[segment].edge = edge;
  return segment;
}

void SegmentMaker::add_boundary(FacetId facet, InputHalfedgeId halfedge, CornerNodes& nodes) {
  const SegmentId segment = of_edge_along(operands_.edge(halfedge), halfedge, nodes);
  // The facet lies to the left of its half-edge, seen from its own front.
  const bool runs_along = node_at(halfedge, nodes) == complex_.segments[segment].from;
  const bool is_left = runs_along == (facets_[facet].orientation > 0);
  complex_.incidences.push_back({segment, facet, is_left ? FacetSides::left : FacetSides::right});
}

/// Calls visit(facet, half-edge) for the boundaries of all facets.
template <typename Visit>
void SegmentMaker::for_each_boundary(const Visit& visit) const {
  for (const FacetId facet : facets_.ids())
    for (const InputFaceId face : facets_.faces_of(facet))
      for (const InputHalfedgeId h : Operands::halfedges(face))
        if (facets_.is_boundary(operands_, h)) visit(facet, h);
}

void SegmentMaker::reserve(std::size_t contact_count) {
  std::size_t incidence_count = 0, edge_count = 0;
  for_each_boundary([&](FacetId, InputHalfedgeId h) {
    ++incidence_count;
    edge_count += Operands::halfedge(operands_.edge(h)) == h ? 1 : 0;
  });
  // A closed mesh has three times as many edges as vertices, and edges that meet planes are about as many as contacts.
  complex_.nodes = NodePool(contact_count + edge_count / 3);
  complex_.segments.reserve(contact_count + edge_count);
  // Lists that are freed before there are sub-edges are allocated one after the other, so that sub-edges find room
  // there.
  of_edges_.reserve(edge_count);
  between_.reserve(contact_count + edge_count);
  complex_.incidences.reserve(2 * contact_count + incidence_count);
  complex_.cuts.reserve(2 * contact_count);
}

void SegmentMaker::add_boundaries() {
  CornerNodes nodes;
  InputFaceId of_nodes;
  for_each_boundary([&](FacetId facet, InputHalfedgeId h) {
    if (const InputFaceId face = Operands::face(h); face != of_nodes) {
      nodes = {};
      of_nodes = face;
    }
    add_boundary(facet, h, nodes);
  });
}

}  // namespace algebra3d::arrangement
