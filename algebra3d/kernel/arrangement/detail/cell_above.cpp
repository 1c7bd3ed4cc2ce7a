#include "algebra3d/kernel/arrangement/detail/cell_above.h"

#include "algebra3d/kernel/arrangement/detail/faces_above.h"

namespace algebra3d::arrangement {

SubEdgeSide half_plane_before_cell_above(const Subdivision& subdivision, std::span<const SubEdgeSide> around) {
  const auto next = [&](std::size_t i) { return around[i + 1 == around.size() ? 0 : i + 1]; };
  // Whether the cell above comes within half a turn after the half-plane.
  const auto comes_soon = [&](SubEdgeSide h) {
    return is_cell_above_in_front(subdivision.plane_of(h.sub_edge()).triangle()) == (h.side() == Side::left);
  };
  for (std::size_t i = 0; i < around.size(); ++i)
    if (comes_soon(around[i]) && !comes_soon(next(i))) return around[i];
  // All half-planes lie on one side of the direction, so it is in the gap of more than half a turn.
  for (std::size_t i = 0; i < around.size(); ++i)
    if (turn_around_line(subdivision, around[i], next(i)) < 0) return around[i];
  return around.front();
}

}  // namespace algebra3d::arrangement
