#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra3d/halfedge/halfedge_structure.h"

namespace algebra3d {

template <typename Layout>
class HalfedgeMesh;  // of the library itself

/// The first half-edge along the edge of `h`, itself perhaps.
template <typename Layout, typename Arrays>
HalfedgeId first_along(const HalfedgeStructure<Layout, Arrays>& mesh, HalfedgeId h) {
  if (mesh.is_nonmanifold(h)) return mesh.edge_halfedges(h).front();
  const HalfedgeId opposite = mesh.opposite(h);
  return opposite.is_valid() && opposite < h ? opposite : h;
}

/// The numbers of the edges of a mesh, from half-edges and back. Memory: 1.75 bits per half-edge.
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
  /// The first half-edge of an edge. Cost: constant where edges have their first half-edges near one another, as in the
  /// whole of most meshes; else a binary search among those of 64 edges.
  HalfedgeId first_halfedge(EdgeId edge) const;

 private:
  static constexpr std::size_t kBits = 64;

  std::vector<std::uint64_t> is_first_;  // a bit per half-edge
  std::vector<std::uint32_t> counts_;    // of set bits before each word
  std::vector<std::uint32_t> samples_;   // the word of every 64th edge, and of the last one
  std::size_t count_ = 0;
};

}  // namespace algebra3d
