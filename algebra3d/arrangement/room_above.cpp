#include "algebra3d/arrangement/room_above.h"

#include <limits>

namespace algebra3d::arrangement {

bool is_room_above_in_front(const TriangleRef& triangle) {
  // The signs of the normal's coordinates, the one that counts most first.
  for (const Projection projection : {Projection::xy, Projection::yz, Projection::zx})
    if (const int sign = orient2d(projection, triangle[0], triangle[1], triangle[2]); sign != 0) return sign > 0;
  return false;
}

HalfPlane before_room_above(const Skeleton& skeleton, const Pieces& pieces, std::span<const HalfPlane> around) {
  const auto follows = [](std::size_t i, std::size_t count) { return i + 1 == count ? 0 : i + 1; };
  // Whether the room above comes within half a turn after the half-plane.
  const auto comes_soon = [&](const HalfPlane& h) {
    const Plane& plane = skeleton.facets().planes()[pieces.pieces[h.piece].plane];
    return is_room_above_in_front(plane.triangle) == (h.side == 0);
  };
  for (std::size_t i = 0; i < around.size(); ++i)
    if (comes_soon(around[i]) && !comes_soon(around[follows(i, around.size())])) return around[i];
  // All half-planes lie on one side of the direction, so it is in the gap of more than half a turn.
  for (std::size_t i = 0; i < around.size(); ++i)
    if (turn_around_line(skeleton, pieces, around[i], around[follows(i, around.size())]) < 0) return around[i];
  return around.front();
}

Windings RoomsAbove::windings(const PointRef& point) {
  Box3 above = box_of(point);
  above.max.z = std::numeric_limits<double>::max();
  Windings windings{};
  for (const std::uint32_t operand : location_.operands_meeting(above))
    windings[operands_.group(operand)] += location_.crossings_above(operand, point);
  return windings;
}

}  // namespace algebra3d::arrangement
