#pragma once

#include <cstdint>
#include <functional>

#include "algebra3d/arrangement/face_tree.h"
#include "algebra3d/arrangement/operands.h"

namespace algebra3d::arrangement {

/// The faces of all operands that a vertical line meets above a point, from the lowest one on.
class FacesAbove {
 public:
  /// A face that is met, and whether its normal points up (1) or down (-1).
  using Visit = std::function<bool(std::uint32_t face, int sign)>;

  FacesAbove(const Operands& operands, FaceTree& faces) : operands_(operands), faces_(faces) {}

  /// Calls visit for each, until it gives false; the line is moved by (e, e^2), as that of cross_vertical_line. The
  /// point may lie on faces, which are not above it. False if two faces are met at the same height, so that they have
  /// no order; visit was called for those below. Exact. Cost: that of a column of boxes up to the last face visited;
  /// the first call makes the tree of all faces.
  bool for_each(const PointRef& point, const Visit& visit);

 private:
  struct Meeting;

  const Operands& operands_;
  FaceTree& faces_;
};

}  // namespace algebra3d::arrangement
