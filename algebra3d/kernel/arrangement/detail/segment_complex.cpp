#include "algebra3d/kernel/arrangement/detail/segment_complex.h"

#include "algebra3d/kernel/arrangement/detail/task_sizes.h"
#include "base/scheduler.h"

namespace algebra3d::arrangement {

PlaneCoefficients::PlaneCoefficients(const Facets& facets) {
  known_.reserve(facets.planes.size());
  for (const Plane& plane : facets.planes) known_.push_back(plane.coefficients);
}

const IntegerPlane& PlaneCoefficients::get(const Facets& facets, PlaneId plane) {
  if (known_[plane].is_null()) known_[plane] = IntegerPlane::through(facets.planes[plane].triangle());
  return known_[plane];
}

void PlaneCoefficients::compute(const Facets& facets, std::span<const PlaneId> planes) {
  parallel_for(planes.size(), kPointsPerTask, [&](std::size_t i) { get(facets, planes[i]); });
}

IntegerPlane PlaneCoefficients::find_or_compute(const Facets& facets, PlaneId plane) const {
  return known_[plane].is_null() ? IntegerPlane::through(facets.planes[plane].triangle()) : known_[plane];
}

PlaneId other_plane(const Facets& facets, const Segment& segment, PlaneId plane) {
  const PlaneId first = facets[segment.first_facet].plane;
  return first != plane ? first : facets[segment.second_facet].plane;
}

}  // namespace algebra3d::arrangement
