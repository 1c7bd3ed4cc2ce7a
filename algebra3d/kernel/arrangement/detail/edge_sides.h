#pragma once

#include <array>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/ids.h"
#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d::arrangement {

/// An edge of an operand by its ends.
struct InputEdgeEnds {
  PointRef a, b;
  InputVertexId vertex_a, vertex_b;
};

/// Computes on which side one edge passes another: orient3d of their four ends. Signs that need exact arithmetic are
/// cached, since the faces on both sides of either edge ask for the same sign soon after each other; where bodies
/// nearly touch this is most of the work.
class EdgeSides {
 public:
  /// orient3d(edge.a, edge.b, other.a, other.b) as far as rounded numbers decide it: -1, 0, 1 or detail::kUndecided.
  /// Ask this first.
  static int rounded_side(const InputEdgeEnds& edge, const InputEdgeEnds& other);
  /// The exact sign of that determinant. A cached sign serves for every order of the edges and of their ends; the
  /// result has the sign of the order given.
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
