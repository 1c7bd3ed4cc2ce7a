#include "algebra3d/kernel/arrangement/detail/seed_from_above.h"

#include "algebra3d/kernel/arrangement/detail/cell_above.h"
#include "algebra3d/kernel/arrangement/detail/faces_above.h"

namespace algebra3d::arrangement {

WindingVector SeedFromAbove::at_place(const SeedPlace& seed) {
  std::vector<SubEdgeSide> around;
  half_planes_with_jumps(jumps_, seed.sub_edges, around);
  sort_around_space_edge(subdivision_, around);
  const SubEdgeSide below = half_plane_before_cell_above(subdivision_, around);
  const auto [u, v] = subdivision_.sub_edges[below.sub_edge()].ends;
  const WindingVector front =
      location_.windings_above(subdivision_.complex.nodes.middle(u, v)) - excess_after(jumps_, below);
  const auto from = linked_.sets.find(linked_.ids.of(below)), to = linked_.sets.find(linked_.ids.of(seed.half_plane));
  return front - from.difference + to.difference;
}

WindingVector SeedFromAbove::at_patch(PatchId patch) {
  const auto& [operand, first_face] = subdivision_.patches[patch];
  const WindingVector above = location_.windings_above(centroid(subdivision_.operands, first_face));
  if (is_cell_above_in_front(subdivision_.operands.corners(first_face))) return above;
  return above - WindingVector::of_group(subdivision_.operands.group(operand), 1);
}

ExactPoint centroid(const Operands& operands, InputFaceId face) {
  const TriangleRef corners = operands.corners(face);
  return ExactPoint(Rational(1, 3) * (corners[0].rational() + corners[1].rational() + corners[2].rational()));
}

}  // namespace algebra3d::arrangement
