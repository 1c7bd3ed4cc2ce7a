#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/arrangement/detail/patches.h"
#include "algebra3d/arrangement/detail/sub_edges.h"

namespace algebra3d::arrangement {

/// An uncut edge: an edge of an operand between a patch and a facet. No other operand touches it. Its own operand may,
/// with a corner or an edge; then it is divided into several space edges. The patch has it whole, so every result that
/// takes the patch has, too.
struct UncutEdge {
  InputEdgeId edge;
  Slice nodes;  ///< of UncutEdges::nodes: those along the segment of the edge, in its direction
};

/// A set of space edges, which is asked for every space edge several times. Constant once it is made.
class SpaceEdgeSet {
 public:
  SpaceEdgeSet() = default;
  /// `edges`: each once. Cost: linear in these and in the nodes.
  SpaceEdgeSet(std::span<const SpaceEdge> edges, std::size_t node_count);

  /// Cost: that of the members with the same first node.
  bool contains(const SpaceEdge& edge) const {
    if (ends_.empty()) return false;
    const std::uint32_t *const begin = &begins_[edge.u.index()], *const end = begin + 1;
    return std::find(ends_.begin() + *begin, ends_.begin() + *end, edge.v) != ends_.begin() + *end;
  }

 private:
  std::vector<std::uint32_t> begins_;  // of ends_: per first node, and where all end
  std::vector<NodeId> ends_;           // the second nodes
};

/// All uncut edges.
struct UncutEdges {
  std::vector<UncutEdge> edges;  ///< in the order of their segments
  std::vector<NodeId> nodes;     ///< edge by edge
  SpaceEdgeSet space_edges;      ///< those along them: where patches end

  std::span<const NodeId> nodes_along(const UncutEdge& edge) const { return edge.nodes.of(nodes); }
};

/// Cost: linear in the segments and nodes.
UncutEdges find_uncut_edges(const Operands& operands, const SegmentComplex& complex, const SubEdges& sub_edges,
                            const Patches& patches);

}  // namespace algebra3d::arrangement
