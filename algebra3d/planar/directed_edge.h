#pragma once

#include <cstdint>
#include <utility>

namespace algebra3d {

/// A directed straight line between two points, given by their indices; what it bounds lies to its left.
using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;

}  // namespace algebra3d
