#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// A segment between two points of a mesh, by their indices.
using FacetSegment = std::pair<std::uint32_t, std::uint32_t>;

/// A canonical form of a point set, independent of its triangulation: coplanar facets, each given by the maximal
/// straight segments of its boundary, without regard to corners of other facets on them. Segments are sorted within a
/// facet, and facets by their segments, by the exact coordinates of the ends.
struct CanonicalFacets {
  std::vector<FacetSegment> segments;         ///< grouped by facet
  std::vector<std::uint32_t> first_of_facet;  ///< with one more at the end

  std::size_t facet_count() const { return first_of_facet.size() - 1; }
  std::span<const FacetSegment> facet(std::size_t number) const {
    return std::span(segments).subspan(first_of_facet[number], first_of_facet[number + 1] - first_of_facet[number]);
  }
};

/// Whether the orientation of the faces is part of the point set: yes for solids, no for surfaces.
enum class Orientation : std::uint8_t { counts, does_not_count };

/// Computes the canonical form of a valid volume (orientation counts) or surface. Segments have the facet to their left
/// if orientation counts, else they begin at the lexicographically smaller end. Exact. Cost: n log n; one orient3d per
/// edge.
CanonicalFacets canonical_facets(const TriangleMesh& mesh, Orientation orientation);

}  // namespace algebra3d
