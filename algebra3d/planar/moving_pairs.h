#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "algebra3d/planar/moving_segments.h"

namespace algebra3d {

/// A rectangle whose sides move evenly: what it holds at s = 0 and at s = 1 it holds, as far as that moves evenly, at
/// all times between.
class MovingBox {
 public:
  void extend(const MovingPoint& point);
  void extend(const MovingBox& other);
  /// True if the two are certain to have no point in common at any time 0 < s < 1.
  bool is_apart_from(const MovingBox& other) const;

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  struct Side {
    double start = -kFar, end = -kFar;
  };
  // The greatest x, y, -x and -y.
  std::array<Side, 4> sides_;
};

/// Finds the moving segments that come near each other, among many: a binary tree of moving boxes, in which those that
/// lie and move alike are together. So it does not matter how far they move.
/// The same segments give the same pairs in the same order.
class MovingPairs {
 public:
  explicit MovingPairs(const std::vector<MovingSegment>& segments);

  /// Calls `visit(i, j)`, i < j, once for each pair that cannot be told apart by boxes, until it gives false.
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
