#include "algebra3d/arrangement/detail/winding_jumps.h"

namespace algebra3d::arrangement {

WindingJumps winding_jumps(const Operands& operands, const Facets& facets, const SubEdges& sub_edges) {
  WindingJumps jumps(sub_edges.sides().size());
  for (const SubEdgeId sub_edge : sub_edges.ids())
    for (const auto& [facet, sides] : sub_edges.incident_to(sub_edge)) {
      const auto& [operand, plane, orientation, faces] = facets[facet];
      for (const Side side : kSides)
        if (includes(sides, side)) jumps[{sub_edge, side}][operands.group(operand)] += orientation;
    }
  return jumps;
}

}  // namespace algebra3d::arrangement
