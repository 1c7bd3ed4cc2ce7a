#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// A straight line between two points of a mesh, by their numbers.
using FacetSegment = std::pair<std::uint32_t, std::uint32_t>;

/// What two meshes of one point set have in common, however they are triangulated: facets (faces of one plane that hang
/// together across edges with two faces), each by the maximal straight segments of its boundary; corners of other
/// facets on them do not count. Segments are sorted within a facet, and facets by their segments, by the exact
/// coordinates of the ends.
struct CanonicalFacets {
  std::vector<FacetSegment> segments;         ///< facet by facet
  std::vector<std::uint32_t> first_of_facet;  ///< and one more at the end

  std::size_t facet_count() const { return first_of_facet.size() - 1; }
  std::span<const FacetSegment> facet(std::size_t number) const {
    return std::span(segments).subspan(first_of_facet[number], first_of_facet[number + 1] - first_of_facet[number]);
  }
};

/// Whether the orientation of the faces belongs to the set: of a solid it says where the inside is.
enum class Orientation : std::uint8_t { counts, does_not_count };

/// Segments run with the facet to their left if orientation counts, else from the lexicographically smaller end.
/// The mesh is a valid volume (then orientation counts) or surface. Exact. Cost: n log n; one orient3d per edge.
CanonicalFacets canonical_facets(const TriangleMesh& mesh, Orientation orientation);

}  // namespace algebra3d
