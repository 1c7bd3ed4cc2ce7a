#pragma once

#include <array>
#include <cstdint>
#include <utility>

namespace algebra3d {

/// The invalid index.
inline constexpr std::uint32_t kNone = 0xFFFFFFFF;

/// A triangle over a list of points: the indices of its corners, counter-clockwise seen from its front.
using IndexTriangle = std::array<std::uint32_t, 3>;

/// A directed edge between two points, given by their indices; the region that it bounds lies to its left.
using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;

}  // namespace algebra3d
