#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/arrangement/pieces.h"

namespace algebra3d::arrangement {

/// The part of a plane to the left (0) or right (1) of a piece.
struct HalfPlane {
  std::uint32_t piece;
  std::uint32_t side;

  std::uint32_t cell_side() const { return 2 * piece + side; }
};

/// Sorts half-planes at one line counter-clockwise, as seen by someone towards whom the line runs from u to v
/// (right-handed), beginning with the first. All pieces are of the same u and v, and no two half-planes are the same.
/// Turning that way, a left half-plane is followed by the room in front of its plane, a right one by the room behind.
/// Exact; decided by corners of input triangles and the two vertices. Cost: n log n.
void sort_around_line(const Skeleton& skeleton, const Pieces& pieces, std::span<HalfPlane> half_planes);

/// Sign of the sine of the angle from a to b, counter-clockwise as above: 1 if b is met within half a turn, 0 if b is
/// opposite to a or the same. Exact.
int turn_around_line(const Skeleton& skeleton, const Pieces& pieces, const HalfPlane& a, const HalfPlane& b);

}  // namespace algebra3d::arrangement
