#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/planar/detail/subdivision.h"

namespace algebra3d::planar {

/// Encodes the mark of a half-edge that is part of a segment: the segment's number, and whether the inside lies to the
/// left of the half-edge. 0 means that the edge is not part of a segment.
inline std::uint32_t segment_mark(SegmentId segment, bool has_inside) {
  return 2 * (segment.index() + 1) + (has_inside ? 1 : 0);
}
inline SegmentId segment_of_mark(std::uint32_t mark) {
  return SegmentId(mark / 2 - 1);
}
inline bool mark_has_inside(std::uint32_t mark) {
  return mark % 2 == 1;
}
/// Marks a half-edge along a segment, which has the inside to its left, and its twin. False if the half-edge has this
/// mark already. An edge with a segment in each direction lies inside.
bool mark_segment(Subdivision& triangulation, HalfedgeId halfedge, SegmentId segment);

/// The triangles inside, in patches connected by edges that are not part of a segment.
struct InsideTriangles {
  /// A half-edge of each triangle, patch by patch; the triangle begins at its origin.
  std::vector<HalfedgeId> halfedges;
  std::vector<std::array<VertexId, 3>> corners;  ///< vertices of each triangle
  std::vector<std::uint32_t> patch_ends;         ///< of each patch: one past its last triangle
  /// A contradiction, if the segments bound no region: a half-edge in an inside patch that has the outside to its left,
  /// or that borders on the unbounded face. The patches are incomplete then.
  std::optional<HalfedgeId> wrong_halfedge;
};

/// Finds the triangles inside. Cost: linear.
InsideTriangles find_inside(const Subdivision& triangulation);

}  // namespace algebra3d::planar
