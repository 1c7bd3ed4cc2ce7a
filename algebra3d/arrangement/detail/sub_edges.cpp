#include "algebra3d/arrangement/detail/sub_edges.h"

#include <functional>
#include <tuple>

#include "algebra3d/arrangement/detail/bucket_sort.h"

namespace algebra3d::arrangement {
namespace {

/// A sub-edge in one facet, before those of one place are brought together.
struct FacetSubEdge {
  SpaceEdge ends;
  PlaneId plane;
  FacetId facet;
  FacetSides sides;

  auto place() const { return std::tie(ends, plane); }
  /// Three numbers, in which they are compared.
  auto key() const {
    return std::tuple(ends.key(), std::uint64_t{plane.index()} << 32U | facet.index(),
                      static_cast<std::uint8_t>(sides));
  }

  friend bool operator==(const FacetSubEdge& a, const FacetSubEdge& b) { return a.key() == b.key(); }
  friend auto operator<=>(const FacetSubEdge& a, const FacetSubEdge& b) { return a.key() <=> b.key(); }
};

/// Ascending, each once.
std::vector<FacetSubEdge> facet_sub_edges(const Facets& facets, const SegmentComplex& complex,
                                          const CutSegments& segments) {
  std::vector<FacetSubEdge> result;
  result.reserve(complex.incidences.size() + 2 * complex.cuts.size());
  for (const auto& [segment, facet, sides] : complex.incidences) {
    const auto nodes = segments.nodes(segment);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
      result.push_back({SpaceEdge::of(nodes[i], nodes[i + 1]), facets[facet].plane, facet,
                        nodes[i] < nodes[i + 1] ? sides : opposite(sides)});
  }
  bucket_sort(
      result, complex.nodes.size(), [](const FacetSubEdge& s) { return s.ends.u.index(); }, std::less());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace

SubEdges divide(const Facets& facets, const SegmentComplex& complex) {
  SubEdges result;
  result.segments = CutSegments(complex);
  const std::vector<FacetSubEdge> parts = facet_sub_edges(facets, complex, result.segments);
  result.sub_edges.reserve(parts.size());
  result.incident.reserve(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const FacetSubEdge& part = parts[i];
    if (i == 0 || parts[i - 1].place() != part.place())
      result.sub_edges.push_back({part.ends, part.plane, Slice::from(result.incident.size(), result.incident)});
    // Sides are sorted with `both` first: a facet that is cut along its own boundary is on the side of that.
    const bool has_boundary =
        i + 1 < parts.size() && parts[i + 1].place() == part.place() && parts[i + 1].facet == part.facet;
    if (part.sides == FacetSides::both && has_boundary) continue;
    result.incident.push_back({part.facet, part.sides});
    ++result.sub_edges.back().incident.last;
  }
  return result;
}

}  // namespace algebra3d::arrangement
