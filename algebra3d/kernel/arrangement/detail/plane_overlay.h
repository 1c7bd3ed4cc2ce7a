#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/plane_elements.h"

namespace algebra3d::arrangement {

/// Two segments that cross in a point inside of both, in a plane.
struct SegmentCrossing {
  PlaneId plane;
  SegmentId first, second;
};

/// Cuts, collinear pairs and crossings of the segments of some planes, to be added to a SegmentComplex. Crossings have
/// no nodes yet.
struct PlaneCuts {
  std::vector<Cut> cuts;
  std::vector<CollinearSegments> collinear;
  std::vector<SegmentCrossing> crossings;

  /// Number of cuts, with the two of each crossing.
  std::size_t count() const { return cuts.size() + 2 * crossings.size(); }
};

/// Adds to `found` how the elements of one plane, at least one, cut each other. Several planes may be done in parallel.
/// Exact. Cost: n log n in the elements and the pairs whose boxes meet.
void overlay_plane(const Facets& facets, const SegmentComplex& complex, std::span<const PlaneElement> elements,
                   PlaneCuts& found);

}  // namespace algebra3d::arrangement
