#pragma once

#include <array>
#include <vector>

#include "algebra3d/arrangement/detail/ids.h"
#include "algebra3d/exact/predicates.h"

namespace algebra3d::arrangement {

/// An edge of an operand by its ends.
struct InputEdgeEnds {
  PointRef a, b;
  InputVertexId vertex_a, vertex_b;
};

/// The orientation of two edges that pass one another: orient3d of their four ends. Signs that needed exact arithmetic
/// are cached, since the faces on both sides of either edge ask for the same sign soon after each other; where bodies
/// nearly touch this is most of the work.
class EdgeSides {
 public:
  /// Exact. The ends of either edge may come in either order.
  int side(const InputEdgeEnds& edge, const InputEdgeEnds& other);

 private:
  static constexpr std::size_t kPlaces = 4096;
  struct Known {
    std::array<InputVertexId, 4> vertices;  // none: nothing is known here
    int side = 0;
  };

  std::vector<Known> known_;  // each at the place that its vertices give, or forgotten; empty before the first
};

}  // namespace algebra3d::arrangement
