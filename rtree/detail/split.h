#pragma once

#include <array>
#include <span>

#include "rtree/detail/node.h"

namespace rtree {

/// Maximum number of entries to distribute over two sibling nodes.
inline constexpr std::size_t kMaxSplit = kFanOut + kFanOut - 1;

/// Reorders `entries` (kFanOut + 1 to kMaxSplit of them) and returns how many of them the first of two nodes gets; both
/// get kMinFill to kFanOut. Axis of least margin, then distribution of least overlap, then of least volume; ties are
/// broken by the lower axis and the smaller first group. Source: [beckmann1990], section 4.2.
template <typename Payload>
std::size_t split(std::span<Entry<Payload>> entries);

}  // namespace rtree
