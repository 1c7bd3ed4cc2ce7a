#include "algebra3d/kernel/arrangement/detail/plane_elements.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>

namespace algebra3d::arrangement {
namespace {

/// The order of the elements of one plane.
bool is_less(const PlaneElement& a, const PlaneElement& b) {
  if (a.segment != b.segment) return a.segment < b.segment;
  return std::tuple(a.from, a.facet, a.is_boundary) < std::tuple(b.from, b.facet, b.is_boundary);
}

bool are_one(const PlaneElement& a, const PlaneElement& b) {
  return a.segment == b.segment && a.from == b.from;
}

/// The number of an incidence, or of a touch behind all incidences.
PlaneId plane_of(const Facets& facets, const SegmentComplex& complex, std::size_t number) {
  const std::size_t count = complex.incidences.size();
  return facets[number < count ? complex.incidences[number].facet : complex.touches[number - count].facet].plane;
}

}  // namespace

PlaneElements::PlaneElements(const Facets& facets, const SegmentComplex& complex)
    : complex_(complex),
      by_plane_(complex.incidences.size() + complex.touches.size(), facets.planes.size(),
                [&](std::size_t number) { return plane_of(facets, complex, number).index(); }) {}

PlaneElement PlaneElements::element(PlaneId plane, std::size_t number) const {
  const std::size_t incidence_count = complex_.incidences.size();
  if (number >= incidence_count) {
    const auto& [facet, node] = complex_.touches[number - incidence_count];
    return {plane, {}, node, node, facet, false};
  }
  const SegmentIncidence& incidence = complex_.incidences[number];
  const Segment& segment = complex_.segments[incidence.segment];
  return {plane, incidence.segment, segment.from, segment.to, incidence.facet, incidence.sides != FacetSides::both};
}

void PlaneElements::collect(PlaneId plane, std::vector<PlaneElement>& elements) const {
  elements.clear();
  for (const std::uint32_t number : by_plane_.of(plane.index())) elements.push_back(element(plane, number));
  std::sort(elements.begin(), elements.end(), is_less);
  std::size_t distinct = 0;
  for (const PlaneElement& element : elements) {
    if (distinct == 0 || !are_one(elements[distinct - 1], element)) {
      elements[distinct++] = element;
      continue;
    }
    PlaneElement& known = elements[distinct - 1];
    if (known.facet != element.facet) known.facet = FacetId::none();
    known.is_boundary |= element.is_boundary;
  }
  elements.resize(distinct);
}

}  // namespace algebra3d::arrangement
