#pragma once

#include <vector>

#include "algebra3d/kernel/arrangement/detail/numbers_by_bucket.h"
#include "algebra3d/kernel/arrangement/detail/segment_complex.h"

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

/// The elements of all planes, made for one plane at a time.
class PlaneElements {
 public:
  /// Cost: linear in the incidences and touches.
  PlaneElements(const Facets& facets, const SegmentComplex& complex);

  /// The elements of a plane, each once, however many facets hold it, ascending by segments. Replaces `elements`. Calls
  /// in parallel are safe. Cost: near-linear.
  void collect(PlaneId plane, std::vector<PlaneElement>& elements) const;

 private:
  PlaneElement element(PlaneId plane, std::size_t number) const;

  const SegmentComplex& complex_;
  NumbersByBucket by_plane_;  // incidences, then touches
};

}  // namespace algebra3d::arrangement
