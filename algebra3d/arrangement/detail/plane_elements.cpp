#include "algebra3d/arrangement/detail/plane_elements.h"

#include <cstdint>
#include <tuple>

#include "algebra3d/arrangement/detail/bucket_sort.h"

namespace algebra3d::arrangement {
namespace {

std::uint64_t line_of(const PlaneElement& element) {
  return std::uint64_t{element.plane.index()} << 32U | element.segment.index();
}

bool is_less(const PlaneElement& a, const PlaneElement& b) {
  const std::uint64_t line_a = line_of(a), line_b = line_of(b);
  if (line_a != line_b) return line_a < line_b;
  return std::tuple(a.from, a.facet, a.is_boundary) < std::tuple(b.from, b.facet, b.is_boundary);
}

bool are_one(const PlaneElement& a, const PlaneElement& b) {
  return line_of(a) == line_of(b) && a.from == b.from;
}

/// With repetitions.
std::vector<PlaneElement> sorted_elements(const Facets& facets, const SegmentComplex& complex) {
  std::vector<PlaneElement> elements;
  elements.reserve(complex.incidences.size() + complex.touches.size());
  for (const SegmentIncidence& incidence : complex.incidences) {
    const Segment& segment = complex.segments[incidence.segment];
    elements.push_back({facets[incidence.facet].plane, incidence.segment, segment.from, segment.to, incidence.facet,
                        incidence.sides != FacetSides::both});
  }
  for (const auto& [facet, node] : complex.touches)
    elements.push_back({facets[facet].plane, {}, node, node, facet, false});
  bucket_sort(
      elements, facets.planes.size(), [](const PlaneElement& e) { return e.plane.index(); }, is_less);
  return elements;
}

}  // namespace

std::vector<PlaneElement> plane_elements(const Facets& facets, const SegmentComplex& complex) {
  std::vector<PlaneElement> distinct;
  for (const PlaneElement& element : sorted_elements(facets, complex)) {
    if (distinct.empty() || !are_one(distinct.back(), element)) {
      distinct.push_back(element);
      continue;
    }
    if (distinct.back().facet != element.facet) distinct.back().facet = FacetId::none();
    distinct.back().is_boundary |= element.is_boundary;
  }
  return distinct;
}

}  // namespace algebra3d::arrangement
