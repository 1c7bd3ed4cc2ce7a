#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra3d/kernel/halfedge/halfedge_mesh.h"

namespace algebra3d {

/// An undirected edge of a mesh: manifold, boundary or non-manifold. Numbered in order of the first half-edges.
using EdgeId = StrongId<struct EdgeKind>;

/// The first half-edge along the edge of `h`, itself perhaps.
template <typename Layout>
HalfedgeId first_along(const HalfedgeMesh<Layout>& mesh, HalfedgeId h) {
  if (mesh.is_nonmanifold(h)) return mesh.edge_halfedges(h).front();
  const HalfedgeId opposite = mesh.opposite(h);
  return opposite.is_valid() && opposite < h ? opposite : h;
}

/// The numbers of the edges of a mesh, from half-edges and back. Memory: 1.5 bits per half-edge.
class EdgeNumbers {
 public:
  EdgeNumbers() = default;
  /// Cost: linear.
  template <typename Layout>
  explicit EdgeNumbers(const HalfedgeMesh<Layout>& mesh);

  std::size_t count() const { return count_; }
  /// The edge whose first half-edge is `first` (see first_along). Cost: constant.
  EdgeId edge(HalfedgeId first) const {
    const std::size_t word = first.index() / kBits;
    const std::uint64_t before = (std::uint64_t{1} << first.index() % kBits) - 1;
    return EdgeId(counts_[word] + static_cast<std::size_t>(std::popcount(is_first_[word] & before)));
  }
  /// The first half-edge of an edge. Cost: a binary search.
  HalfedgeId first_halfedge(EdgeId edge) const;

 private:
  static constexpr std::size_t kBits = 64;

  std::vector<std::uint64_t> is_first_;  // a bit per half-edge
  std::vector<std::uint32_t> counts_;    // of set bits before each word
  std::size_t count_ = 0;
};

extern template EdgeNumbers::EdgeNumbers(const HalfedgeMesh<TriangleLayout>&);
extern template EdgeNumbers::EdgeNumbers(const HalfedgeMesh<PolygonLayout>&);

}  // namespace algebra3d
