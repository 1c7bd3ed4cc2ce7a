#include "algebra3d/kernel/arrangement/detail/segment_complex.h"

namespace algebra3d::arrangement {

PlaneId other_plane(const Facets& facets, const Segment& segment, PlaneId plane) {
  const PlaneId first = facets[segment.first_facet].plane;
  return first != plane ? first : facets[segment.second_facet].plane;
}

}  // namespace algebra3d::arrangement
