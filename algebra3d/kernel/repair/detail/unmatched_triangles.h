#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/base/strong_id.h"
#include "algebra3d/kernel/repair/detail/known_triangles.h"
#include "algebra3d/kernel/repair/detail/measure_frame.h"
#include "algebra3d/kernel/repair/detail/triangle_parts.h"
#include "base/id_vector.h"
#include "rtree/rtree.h"

namespace algebra3d {

/// A triangle of UnmatchedTriangles.
using UnmatchedId = StrongId<struct UnmatchedTag>;

/// The triangles of one surface that are not in the other.
struct UnmatchedTriangles {
  IdVector<UnmatchedId, MeasuredTriangle> triangles;
  IdVector<UnmatchedId, std::uint64_t> copies;  ///< number of triangles with the same corners
  rtree::RTree<std::uint32_t> tree;             ///< of their boxes, widened by the tolerance

  /// Adds a triangle of which there are `count` copies.
  void add(const Triangle3& corners, std::uint64_t count);
  /// Makes the tree. Call once, after all triangles were added.
  void index(double tolerance);
  /// The box of a triangle, widened.
  Box3 box(UnmatchedId i, double wider) const;
  /// The entries of a tree whose boxes meet that of the triangle, widened; ascending.
  std::vector<std::uint32_t> near(UnmatchedId i, const rtree::RTree<std::uint32_t>& others, double wider) const;
};

/// The corners of a triangle in ascending order, independent of its orientation.
Triangle3 key_of(Triangle3 corners);

/// The comparison of two surfaces, triangle by triangle.
struct TriangleMatching {
  UnmatchedTriangles given, solid;  ///< `given` is sorted by key, without duplicates in either orientation
  double matched_area = 0;          ///< scaled; copies count once
};

/// Matches triangles with the same three corners. `recognised`: pairs that are known; may be empty. Degenerate
/// triangles are left out. Cost: linear, n log n in the triangles that are not known.
TriangleMatching match_triangles(const MeasureFrame& frame, const FaceMatches& recognised);

}  // namespace algebra3d
