#pragma once

#include <array>

#include "algebra3d/kernel/arrangement/detail/segment_complex.h"
#include "base/id_map.h"

namespace algebra3d::arrangement {

/// The segments of a complex, made when they are asked for and then remembered.
class SegmentMaker {
 public:
  SegmentMaker(const Operands& operands, const Facets& facets, SegmentComplex& complex)
      : operands_(operands), facets_(facets), complex_(complex) {}

  /// Makes room for the nodes and segments of all boundary edges and of at most so many contacts, before all else.
  void reserve(std::size_t contact_count);
  /// The node at the origin of the half-edge.
  NodeId node_at_origin(InputHalfedgeId halfedge);
  /// The segment of a boundary edge of some facet.
  SegmentId of_edge(InputEdgeId edge);
  /// The segment of a common part of two facets. If the common part runs along a boundary edge and is shorter than it,
  /// it is a segment of its own; the caller notes that it is collinear with the edge's segment. Adds an incidence for
  /// each of the two facets, with FacetSides::both also for a facet that ends there: its boundary edge gives another
  /// incidence, with the side, and stage 6 (sub_edges.h) prefers that.
  SegmentId of_contact(NodeId from, NodeId to, FacetId facet, FacetId other);
  /// Adds the segments of all boundary edges of all facets, with one incidence for each facet and edge, with the side
  /// on which the facet lies. Call once, after all contacts.
  void add_boundaries();

 private:
  /// The nodes at the corners of a face, each none until it is asked for.
  using CornerNodes = std::array<NodeId, 3>;

  SegmentId between(NodeId from, NodeId to);
  template <typename Visit>
  void for_each_boundary(const Visit& visit) const;
  NodeId node_at(InputHalfedgeId corner, CornerNodes& nodes);
  SegmentId of_edge_along(InputEdgeId edge, InputHalfedgeId halfedge, CornerNodes& nodes);
  void add_boundary(FacetId facet, InputHalfedgeId halfedge, CornerNodes& nodes);

  const Operands& operands_;
  const Facets& facets_;
  SegmentComplex& complex_;
  IdMap<NodeId> nodes_of_vertices_;
  IdMap<SegmentId> of_edges_;
  IdMap<SegmentId> between_;  // by both ends
};

}  // namespace algebra3d::arrangement
