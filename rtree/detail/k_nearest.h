#pragma once

#include <vector>

#include "rtree/detail/node_scan.h"
#include "rtree/detail/storage.h"

namespace rtree {

/// A slot of a leaf.
struct LeafSlot {
  NodeIndex leaf;
  std::uint32_t slot;
};

/// Maximum of `k` for k_nearest, which keeps a sorted list of that length. Chosen, not measured.
inline constexpr std::size_t kMostNearest = 64;
/// Coordinates up to here have squares that do not overflow.
inline constexpr double kNoSquareOverflow = 0x1p500;

/// A few entries, among which are the `k` nearest to the target, found by keys alone. Domain: the tree is not empty;
/// its coordinates and those of the target are at most kNoSquareOverflow; k is from 1 to kMostNearest. Source:
/// [roussopoulos1995], with the order of children by distance.
template <typename Leaf>
std::vector<LeafSlot> k_nearest(const TreeView<Leaf>& tree, const Target& target, std::size_t k);

}  // namespace rtree
