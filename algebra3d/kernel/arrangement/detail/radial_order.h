#pragma once

#include <span>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/subdivision.h"
#include "algebra3d/kernel/arrangement/detail/winding_jumps.h"

namespace algebra3d::arrangement {

/// The half-planes at a space edge that facets cover. A half-plane is the part of a plane to the left or right of a
/// sub-edge, so a SubEdgeSide stands for it. All functions here are about one space edge: about the half-planes at
/// sub-edges with the same ends u and v. `edge`: all these sub-edges (SubEdges::along). Replaces `result`.
void covered_half_planes(const SubEdges& sub_edges, IdRange<SubEdgeId> edge, std::vector<SubEdgeSide>& result);
/// The covered half-planes with a winding jump: windings behind them differ from those in front. Replaces `result`.
void half_planes_with_jumps(const WindingJumps& jumps, IdRange<SubEdgeId> edge, std::vector<SubEdgeSide>& result);

/// Sorts half-planes counter-clockwise, as seen by someone towards whom the edge runs from u to v (right-handed),
/// beginning with the first. No two half-planes are the same. Turning that way, a left half-plane is followed by the
/// cell in front of its plane, a right one by the cell behind.
/// Exact; decided by corners of input triangles and the two nodes. Cost: n log n.
void sort_around_space_edge(const Subdivision& subdivision, std::span<SubEdgeSide> half_planes);

/// Sign of the sine of the angle from a to b, counter-clockwise as above: 1 if b is met within half a turn, -1 if after
/// more, 0 if b is opposite to a or the same. Exact.
int turn_around_line(const Subdivision& subdivision, SubEdgeSide a, SubEdgeSide b);

/// By how much the windings of the cell that follows the half-plane counter-clockwise exceed its front winding.
inline WindingVector excess_after(const WindingJumps& jumps, SubEdgeSide half_plane) {
  return half_plane.side() == Side::left ? WindingVector() : jumps[half_plane];
}
/// By how much the windings of the cell before the half-plane exceed its front winding.
inline WindingVector excess_before(const WindingJumps& jumps, SubEdgeSide half_plane) {
  return half_plane.side() == Side::left ? jumps[half_plane] : WindingVector();
}

}  // namespace algebra3d::arrangement
