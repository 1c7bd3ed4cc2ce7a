#pragma once

#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "rtree/rtree.h"

namespace algebra3d {

/// An edge with one triangle, in the direction of that triangle.
struct BoundaryEdge {
  HalfedgeId halfedge;  ///< of the soup's mesh
  VertexId from, to;
};

/// The boundary of a soup: its edges and their vertices. Not updated when the soup changes.
struct BoundaryEdges {
  std::vector<BoundaryEdge> edges;  ///< ascending by half-edge
  std::vector<VertexId> vertices;   ///< ascending, without duplicates

  /// Cost: linear, n log n in the boundary.
  explicit BoundaryEdges(const IndexedSoup& soup);

  /// An R-tree of the vertices.
  rtree::RTree<std::uint32_t> vertex_tree(const IndexedSoup& soup) const;
};

/// The box, enlarged by `by` on each side.
Box3 widened(Box3 box, double by);

}  // namespace algebra3d
