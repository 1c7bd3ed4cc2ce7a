#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/arrangement/patches.h"
#include "algebra3d/arrangement/skeleton.h"

namespace algebra3d::arrangement {

/// An edge of an operand with a face that touches nothing beside one that does. No other operand is there; but its own
/// one may touch it, with a corner or an edge, so it may be more than one piece. The face that touches nothing has it
/// whole in every result.
struct CleanEdge {
  std::uint32_t segment;
  std::vector<std::uint32_t> halfedges;  ///< all along it
};

/// All of them, in the order of their segments. Cost: linear in the segments.
std::vector<CleanEdge> clean_edges(const Skeleton& skeleton, const Patches& patches);

}  // namespace algebra3d::arrangement
