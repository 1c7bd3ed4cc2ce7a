#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra3d/kernel/subdivision/detail/blocks.h"
#include "algebra3d/kernel/subdivision/detail/mesh_view.h"

namespace algebra3d::subdivision {

/// Which edges have numbers.
enum class Edges : std::uint8_t { all, interior, boundary };

/// The number of an edge among those that have numbers.
using EdgeNumber = StrongId<struct EdgeNumberKind>;

/// Numbers of edges, in the order of their first half-edges.
template <typename View>
class EdgeEnumeration {
 public:
  /// Steps of the stage: block_count(half-edges).
  EdgeEnumeration(const View& view, Edges edges, const Stage& stage)
      : view_(view), edges_(edges), starts_(block_count(view.halfedge_count()) + 1, 0) {
    for_each_block<HalfedgeId>(view_.halfedge_count(), stage, [&](std::size_t block, IdRange<HalfedgeId> halfedges) {
      std::size_t found = 0;
      for (const HalfedgeId h : halfedges) found += is_numbered(h) ? 1 : 0;
      starts_[block + 1] = found;
    });
    for (std::size_t block = 1; block < starts_.size(); ++block) starts_[block] += starts_[block - 1];
  }

  std::size_t count() const { return starts_.back(); }

  /// Calls visit(h, e) for the first half-edge of each edge and its number, in parallel. Steps of the stage:
  /// block_count(half-edges).
  template <typename Visit>
  void for_each(const Stage& stage, const Visit& visit) const {
    for_each_block<HalfedgeId>(view_.halfedge_count(), stage, [&](std::size_t block, IdRange<HalfedgeId> halfedges) {
      std::size_t number = starts_[block];
      for (const HalfedgeId h : halfedges)
        if (is_numbered(h)) visit(h, EdgeNumber(number++));
    });
  }

 private:
  bool is_numbered(HalfedgeId h) const {
    return view_.is_first_of_edge(h) && (edges_ == Edges::all || view_.is_boundary(h) == (edges_ == Edges::boundary));
  }

  View view_;
  Edges edges_;
  std::vector<std::size_t> starts_;  // per block of half-edges, and the end
};

}  // namespace algebra3d::subdivision
