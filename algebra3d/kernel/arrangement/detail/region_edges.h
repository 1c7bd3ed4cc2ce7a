#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/selection.h"
#include "algebra3d/kernel/arrangement/detail/subdivision.h"

namespace algebra3d::arrangement {

/// A region of a result: all its faces made of facets that lie in one plane and have their front on the same side. It
/// need not be connected.
class RegionKey {
 public:
  RegionKey() = default;
  RegionKey(PlaneId plane, bool is_flipped)
      : plane_and_flip_(plane.index() << 1U | static_cast<std::uint32_t>(is_flipped)) {}

  PlaneId plane() const { return PlaneId(plane_and_flip_ >> 1U); }
  /// The region's own front is the back of the plane.
  bool is_flipped() const { return plane_and_flip_ % 2 == 1; }

  friend auto operator<=>(const RegionKey&, const RegionKey&) = default;

 private:
  std::uint32_t plane_and_flip_ = 0;  // there are no more planes than faces, fewer than 2^30 (TriangleMesh::kMaxFaces)
};

/// A boundary edge of a region. The region is to the left of it, seen from the front of the plane, also if the region
/// is flipped.
struct RegionEdge {
  RegionKey region;
  NodeId from, to;

  friend auto operator<=>(const RegionEdge&, const RegionEdge&) = default;
};

/// The boundary edges of all regions of a selection. A space edge at which anything is kept is an edge of the result,
/// unless exactly two kept half-planes lie at it, in one plane and with the same front, and no patch ends there.
/// Cost: near-linear in the sub-edges.
std::vector<RegionEdge> region_edges(const Subdivision& subdivision, const Selection& selection);

/// Every violated invariant, one sentence each: an edge leads from one node to another one, both in the plane of its
/// region; a region has no edge twice; at each node as many edges of a region end as begin. So for edges that were
/// straightened, too. Cost: n log n, with exact predicates.
std::vector<std::string> audit(const Subdivision& subdivision, const std::vector<RegionEdge>& edges);

}  // namespace algebra3d::arrangement
