#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algebra3d/exact/predicates.h"

namespace algebra3d::arrangement {

/// The ends of an edge, each with a number that no other point of the same arrangement has.
struct NumberedEdge {
  PointRef a, b;
  std::uint32_t number_of_a, number_of_b;
};

/// On which side two edges pass one another: orient3d of their four ends. Remembers what rounded numbers could not tell
/// for a while: the faces on both sides of either edge ask for the same, one soon after the other, and where bodies
/// nearly touch this is most of the work.
class EdgeSides {
 public:
  /// Exact. Of two edges, the one with the smaller numbers need not come first.
  int side(const NumberedEdge& edge, const NumberedEdge& other);

 private:
  static constexpr std::size_t kPlaces = 4096;
  struct Known {
    std::array<std::uint32_t, 4> numbers{};  // all 0: nothing
    int side = 0;
  };

  std::vector<Known> known_;  // each at the place that its numbers give, or forgotten; empty before the first
};

}  // namespace algebra3d::arrangement
