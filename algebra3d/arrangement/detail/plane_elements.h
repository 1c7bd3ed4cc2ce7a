#pragma once

#include <utility>
#include <vector>

#include "algebra3d/arrangement/detail/segment_complex.h"

namespace algebra3d::arrangement {

/// An element of the overlay of one plane: a segment in the plane, or a node at which another facet touches the plane.
struct PlaneElement {
  PlaneId plane;
  SegmentId segment;  ///< none for a node
  NodeId from, to;    ///< the ends of the segment; for a node both are the node
  FacetId facet;      ///< the facet of the plane that holds it; none if there are several
  bool is_boundary;   ///< the segment bounds a facet of this plane

  bool is_node() const { return segment.is_none(); }
};

/// All elements of all planes, plane by plane, each once, however many facets hold it. Cost: near-linear.
std::vector<PlaneElement> plane_elements(const Facets& facets, const SegmentComplex& complex);

}  // namespace algebra3d::arrangement
