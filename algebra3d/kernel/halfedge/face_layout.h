#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "algebra3d/halfedge/face_layout.h"
#include "base/large_allocator.h"

namespace algebra3d {

/// The half-edges of polygons, with arrays of its own.
class PolygonLayout : public PolygonLayoutIn<LargeVector<std::uint32_t>> {
 public:
  /// No faces.
  PolygonLayout() = default;
  /// Faces of one degree, at least 1 (asserted); as many as there are half-edges for.
  static PolygonLayout of_degree(std::uint32_t degree) {
    assert(degree > 0);
    PolygonLayout layout;
    layout.set_degree(degree);
    return layout;
  }
  /// Faces of any degrees: `starts` has the first half-edge of each face, and at the end the number of half-edges;
  /// strictly ascending from 0 (asserted). Cost: linear.
  explicit PolygonLayout(LargeVector<std::uint32_t> starts);
};

/// The violated invariants of a mesh with so many half-edges, a sentence each (see `audit`).
std::vector<std::string> layout_violations(const TriangleLayout& layout, std::size_t halfedge_count);
std::vector<std::string> layout_violations(const PolygonLayout& layout, std::size_t halfedge_count);

/// Bytes on the heap by the capacities of the containers.
inline std::size_t layout_bytes(const TriangleLayout& /*layout*/) {
  return 0;
}
inline std::size_t layout_bytes(const PolygonLayout& layout) {
  return (layout.face_starts().capacity() + layout.faces_of_halfedges().capacity()) * sizeof(std::uint32_t);
}

}  // namespace algebra3d
