#include "algebra3d/kernel/arrangement/detail/winding_jumps.h"

#include <array>
#include <cstddef>

namespace algebra3d::arrangement {

WindingJumps winding_jumps(const Operands& operands, const Facets& facets, const SubEdges& sub_edges) {
  WindingJumps jumps(sub_edges.sides().size());
  for (const SubEdgeId sub_edge : sub_edges.ids()) {
    std::array<WindingVector, 2> of_sides;  // left, right
    for (const IncidentFacet& incident : sub_edges.incident_to(sub_edge)) {
      const Facet& facet = facets[incident.facet()];
      const std::size_t group = operands.group(facet.operand);
      // A product, since nobody could predict a branch.
      for (std::size_t i = 0; i < 2; ++i)
        of_sides[i][group] += facet.orientation * static_cast<int>(includes(incident.sides(), kSides[i]));
    }
    for (std::size_t i = 0; i < 2; ++i) jumps.set({sub_edge, kSides[i]}, of_sides[i]);
  }
  return jumps;
}

}  // namespace algebra3d::arrangement
