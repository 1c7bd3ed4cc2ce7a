#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "rtree/detail/node.h"

namespace rtree {

/// Maximum number of boxes to distribute over two sibling nodes.
inline constexpr std::size_t kMaxSplit = kFanOut + kFanOut - 1;

/// A box that is to be distributed, and the order of equal ones.
struct SplitItem {
  Box3 box;
  std::uint64_t reference;
  std::size_t index;  ///< where it was
};

/// Reorders `items` (kFanOut + 1 to kMaxSplit of them) and returns how many of them the first of two nodes gets; both
/// get kMinFill to kFanOut. Axis of least margin, then distribution of least overlap, then of least volume; ties are
/// broken by the lower axis and the smaller first group. Source: [beckmann1990], section 4.2.
std::size_t split(std::span<SplitItem> items);

}  // namespace rtree
