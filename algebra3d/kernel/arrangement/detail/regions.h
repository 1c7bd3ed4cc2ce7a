#pragma once

#include <span>
#include <string>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/arrangement/detail/region_edges.h"
#include "algebra3d/kernel/arrangement/detail/slice.h"

namespace algebra3d::arrangement {

/// A region of the result, triangulated.
struct Region {
  RegionKey key;
  bool has_exact_corner;  ///< a corner is not a triple of doubles
  Slice triangles;        ///< of Regions::triangles
};

/// All regions of a result, ascending.
struct Regions {
  std::vector<Region> regions;
  /// Indices of nodes, region by region; counter-clockwise from the front of the plane.
  std::vector<IndexTriangle> triangles;

  std::span<const IndexTriangle> triangles_of(const Region& region) const { return region.triangles.of(triangles); }
};

/// Triangulates the regions that the edges bound, in parallel if they are many. The edges are ascending. Errors:
/// internal, naming a facet of the plane, if its edges bound no region, which the selection of a correct classification
/// rules out. Exact. Cost: n log n.
Result<Regions> triangulate_regions(const Subdivision& subdivision, const std::vector<RegionEdge>& edges);

/// Every violated invariant, one sentence each: there is one region for each key among the edges, in their order; its
/// triangles have nodes for corners and are counter-clockwise from the front of the plane; an edge of a triangle is a
/// boundary edge of the region or has another triangle on its other side; a corner that is not a double is noted.
/// Cost: n log n, with exact predicates.
std::vector<std::string> audit(const Subdivision& subdivision, const std::vector<RegionEdge>& edges,
                               const Regions& regions);

}  // namespace algebra3d::arrangement
