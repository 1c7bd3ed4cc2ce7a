#pragma once

#include <cstdint>
#include <span>

#include "algebra3d/arrangement/operands.h"
#include "algebra3d/arrangement/point_location.h"
#include "algebra3d/arrangement/radial_order.h"

namespace algebra3d::arrangement {

// The room above a point that may lie on faces is the one in the direction (e, e^2, 1), for an e > 0 smaller than any
// number: no plane holds this direction, so the room is one, and cross_vertical_line looks along the same direction.

/// True if the direction leads from a triangle's plane to its front. Exact.
bool is_room_above_in_front(const TriangleRef& triangle);

/// The half-plane behind which the room above the line comes, counter-clockwise. They are at least one, in the order of
/// sort_around_line. Exact.
HalfPlane before_room_above(const Skeleton& skeleton, const Pieces& pieces, std::span<const HalfPlane> around);

/// Windings of operands of which only all of one group together are closed.
class RoomsAbove {
 public:
  RoomsAbove(const Operands& operands, PointLocation& location) : operands_(operands), location_(location) {}

  /// In the room above the point. Exact. Cost: that of a vertical line through the hierarchies of all operands whose
  /// boxes it meets.
  Windings windings(const PointRef& point);

 private:
  const Operands& operands_;
  PointLocation& location_;
};

}  // namespace algebra3d::arrangement
