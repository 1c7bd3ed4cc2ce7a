#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "algebra3d/kernel/planar/detail/moving_segments.h"

namespace algebra3d {

/// A rectangle whose sides move linearly. It contains any linearly moving point that it contains at s = 0 and at s = 1.
class MovingBox {
 public:
  void extend(const MovingPoint& point);
  void extend(const MovingBox& other);
  /// True if the two are proved to be disjoint at all times 0 < s < 1.
  bool is_apart_from(const MovingBox& other) const;

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  struct Side {
    double start = -kFar, end = -kFar;
  };
  // Upper bounds of x, y, -x and -y.
  std::array<Side, 4> sides_;
};

/// Finds the pairs of moving segments that come near each other: a binary tree of moving boxes, in which segments with
/// similar position and motion are together. The cost does not depend on how far they move. Deterministic.
class MovingPairs {
 public:
  explicit MovingPairs(const std::vector<MovingSegment>& segments);

  /// Calls `visit(i, j)`, i < j, once for each pair that is not separated by boxes, until it returns false.
  void for_each(const std::function<bool(std::uint32_t, std::uint32_t)>& visit) const;

 private:
  struct Node {
    MovingBox box;
    std::uint32_t first = 0, end = 0;  // of its segments in order_
    std::uint32_t right = 0;           // the right child, the left one follows this node; 0: none
  };
  using NodePair = std::pair<std::uint32_t, std::uint32_t>;

  void build(const std::vector<MovingSegment>& segments);
  std::uint32_t size_of(std::uint32_t node) const { return nodes_[node].end - nodes_[node].first; }
  void divide(const NodePair& pair, std::vector<NodePair>& open) const;

  std::vector<std::uint32_t> order_;
  std::vector<MovingBox> boxes_;  // of each segment
  std::vector<Node> nodes_;
};

}  // namespace algebra3d
