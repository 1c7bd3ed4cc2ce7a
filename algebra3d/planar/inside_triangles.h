#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/planar/subdivision.h"

namespace algebra3d::planar {

/// What the mark of a half-edge says in a triangulation in which directed segments are edges: 0 on edges that are no
/// part of a segment; else the segment's number, and whether the inside lies to the left of this half-edge.
inline std::uint32_t segment_mark(std::uint32_t segment, bool has_inside) {
  return 2 * (segment + 1) + (has_inside ? 1 : 0);
}
inline std::uint32_t segment_of_mark(std::uint32_t mark) {
  return mark / 2 - 1;
}
inline bool mark_has_inside(std::uint32_t mark) {
  return mark % 2 == 1;
}
/// Marks a half-edge that runs along the segment, which has the inside to its left, and its twin. False if the inside
/// lies to its left already. An edge with a segment in each direction lies within the inside.
bool mark_segment(Subdivision& triangulation, std::uint32_t halfedge, std::uint32_t segment);

/// The triangles of the inside, in patches that hang together by edges which are no part of a segment.
struct InsideTriangles {
  /// A half-edge of each triangle, patch after patch; the triangle begins at its origin.
  std::vector<std::uint32_t> halfedges;
  std::vector<std::array<std::uint32_t, 3>> corners;  ///< vertices of each triangle
  std::vector<std::uint32_t> patch_ends;              ///< of each patch: one past its last triangle
  /// Where the inside meets the outside, so that the segments bound no region: a half-edge in a patch of the inside
  /// that does not have it to its left, or that the unbounded face should have. The patches then are incomplete.
  std::optional<std::uint32_t> wrong_halfedge;
};

/// Cost: linear.
InsideTriangles find_inside(const Subdivision& triangulation);

}  // namespace algebra3d::planar
