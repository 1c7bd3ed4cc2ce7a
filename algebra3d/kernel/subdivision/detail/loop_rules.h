#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "algebra3d/kernel/subdivision/detail/triangle_split.h"
#include "algebra3d/kernel/subdivision/scheme.h"

namespace algebra3d::subdivision {

/// The weight of each neighbour of an interior vertex by the number of its edges.
class LoopWeightTable {
 public:
  explicit LoopWeightTable(LoopWeights weights);
  double operator()(std::size_t valence) const {
    return valence < kKnown ? known_[valence] : weight(weights_, valence);
  }

 private:
  static constexpr std::size_t kKnown = 64;
  static double weight(LoopWeights weights, std::size_t valence);

  LoopWeights weights_;
  std::array<double, kKnown> known_ = {};
};

/// The sum of the neighbours of an interior vertex, and their number.
struct NeighbourSum {
  Vec3 sum;
  std::size_t count = 0;
};
template <typename View>
NeighbourSum neighbours_of(const View& view, std::uint32_t v) {
  NeighbourSum result;
  view.for_each_outgoing(view.outgoing(v), [&](std::uint32_t h) {
    result.sum = result.sum + view.target_point(h);
    ++result.count;
  });
  return result;
}

/// The sum of the two neighbours of a boundary vertex along the boundary.
template <typename View>
Vec3 boundary_neighbours_of(const View& view, std::uint32_t v) {
  return view.target_point(view.outgoing(v)) + view.point(view.boundary_predecessor(v));
}

}  // namespace algebra3d::subdivision
