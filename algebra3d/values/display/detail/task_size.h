#pragma once

#include <cstddef>

namespace algebra3d::detail {

/// Vertices, triangles or half-edges of a parallel task.
inline constexpr std::size_t kElementsPerTask = 50000;

}  // namespace algebra3d::detail
