#include "algebra3d/kernel/arrangement/detail/seed_from_faces.h"

#include <algorithm>
#include <utility>

#include "algebra3d/kernel/arrangement/detail/radial_order.h"

namespace algebra3d::arrangement {

/// All half-planes in radial order, that of the seed last.
std::vector<SubEdgeSide> SeedFromFaces::half_planes_after(const SeedPlace& seed) const {
  std::vector<SubEdgeSide> around;
  covered_half_planes(subdivision_.sub_edges, seed.sub_edges, around);
  std::swap(around.front(), *std::ranges::find(around, seed.half_plane));
  sort_around_space_edge(subdivision_, around);
  std::rotate(around.begin(), around.begin() + 1, around.end());
  return around;
}

/// Adds the operands with a face at the line that hold the cell before the first half-plane: the first face of an
/// operand that is met from there says on which side of it this is. Gives the operands with faces, ascending.
std::vector<OperandId> SeedFromFaces::add_operands_with_faces(std::span<const SubEdgeSide> around,
                                                              WindingVector& windings) const {
  std::vector<OperandId> known;
  for (const SubEdgeSide h : around)
    for (const IncidentFacet& incident : subdivision_.sub_edges.incident_to(h.sub_edge())) {
      const auto& [operand, plane, orientation, faces] = subdivision_.facets[incident.facet()];
      if (!includes(incident.sides(), h.side()) || std::ranges::find(known, operand) != known.end()) continue;
      known.push_back(operand);
      // A left half-plane is met from behind.
      const bool is_inside = (h.side() == Side::left) == (orientation > 0);
      if (is_inside) ++windings[subdivision_.operands.group(operand)];
    }
  std::ranges::sort(known);
  return known;
}

/// Adds the operands other than `known` (ascending) that hold the point.
void SeedFromFaces::add_others(const PointRef& point, const std::vector<OperandId>& known, WindingVector& windings) {
  for (const OperandId operand : location_.near(point))
    if (!std::ranges::binary_search(known, operand))
      windings[subdivision_.operands.group(operand)] += location_.winding_number(operand, point);
}

WindingVector SeedFromFaces::at_place(const SeedPlace& seed) {
  WindingVector windings;
  const std::vector<OperandId> known = add_operands_with_faces(half_planes_after(seed), windings);
  const auto [u, v] = subdivision_.sub_edges[seed.sub_edges.front()].ends;
  if (known.size() != subdivision_.operands.count())
    add_others(subdivision_.complex.nodes.middle(u, v), known, windings);
  return windings - excess_after(jumps_, seed.half_plane);
}

WindingVector SeedFromFaces::at_patch(PatchId patch) {
  const auto& [operand, first_face] = subdivision_.patches[patch];
  WindingVector windings;
  add_others(subdivision_.operands.point(Operands::halfedge(first_face, 0)), {operand}, windings);
  return windings;
}

}  // namespace algebra3d::arrangement
