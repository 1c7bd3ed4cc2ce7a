#include "algebra3d/kernel/planar/detail/moving_pairs.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "algebra3d/base/box3.h"
#include "base/indices.h"
#include "base/interruption_scope.h"

namespace algebra3d {
namespace {

constexpr std::uint32_t kLeafSize = 4;

/// Where a segment begins and ends its way, by its middle.
using Way = std::array<double, 4>;

Way way_of(const MovingSegment& segment) {
  const Vec3 start = 0.5 * segment.from.start.approx + 0.5 * segment.to.start.approx;
  const Vec3 end = 0.5 * segment.from.end.approx + 0.5 * segment.to.end.approx;
  return {start.x, start.y, end.x, end.y};
}

std::size_t widest_axis(const std::vector<Way>& ways, std::span<const std::uint32_t> indices) {
  Way least = ways[indices[0]];
  Way greatest = least;
  for (const std::uint32_t i : indices)
    for (std::size_t axis = 0; axis < 4; ++axis) {
      least[axis] = std::min(least[axis], ways[i][axis]);
      greatest[axis] = std::max(greatest[axis], ways[i][axis]);
    }
  std::size_t widest = 0;
  for (std::size_t axis = 1; axis < 4; ++axis)
    if (greatest[axis] - least[axis] > greatest[widest] - least[widest]) widest = axis;
  return widest;
}

}  // namespace

void MovingBox::extend(const MovingPoint& point) {
  const Box3 start = box_of(point.start);
  const Box3 end = box_of(point.end);
  MovingBox box;
  box.sides_ = {Side{start.max.x, end.max.x}, Side{start.max.y, end.max.y}, Side{-start.min.x, -end.min.x},
                Side{-start.min.y, -end.min.y}};
  extend(box);
}

void MovingBox::extend(const MovingBox& other) {
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    sides_[i].start = std::max(sides_[i].start, other.sides_[i].start);
    sides_[i].end = std::max(sides_[i].end, other.sides_[i].end);
  }
}

// Of each side the gap to the other box changes evenly. One that is open throughout decides; it may close at the very
// ends, which do not count. Else one that is open from the beginning may last until another has opened for good.
bool MovingBox::is_apart_from(const MovingBox& other) const {
  constexpr double kCertain = 1e-12;  // far above the roundings of a quotient
  double open_until = 0;
  double open_from = 1;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    // In these two directions the sum of the sides is the negative gap; its sign is exact.
    const Side& side = other.sides_[(i + 2) % 4];
    const double start = -(sides_[i].start + side.start);
    const double end = -(sides_[i].end + side.end);
    if (start >= 0 && end >= 0 && (start > 0 || end > 0)) return true;
    if (!std::isfinite(start - end)) continue;
    if (start > 0) open_until = std::max(open_until, start / (start - end));
    if (end > 0) open_from = std::min(open_from, start / (start - end));
  }
  return open_from + kCertain < open_until;
}

MovingPairs::MovingPairs(const std::vector<MovingSegment>& segments) : order_(segments.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  boxes_.resize(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    boxes_[i].extend(segments[i].from);
    boxes_[i].extend(segments[i].to);
  }
  if (!segments.empty()) build(segments);
}

void MovingPairs::build(const std::vector<MovingSegment>& segments) {
  std::vector<Way> ways;
  ways.reserve(segments.size());
  for (const MovingSegment& segment : segments) ways.push_back(way_of(segment));

  struct Task {
    std::uint32_t first, end, parent;
  };
  std::vector<Task> tasks{{0, static_cast<std::uint32_t>(order_.size()), kNone}};
  while (!tasks.empty()) {
    poll_interruption();
    const Task task = tasks.back();
    tasks.pop_back();
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    if (task.parent != kNone) nodes_[task.parent].right = index;
    nodes_.push_back({{}, task.first, task.end, 0});
    if (task.end - task.first <= kLeafSize) continue;
    const std::uint32_t middle = task.first + (task.end - task.first) / 2;
    const std::size_t axis = widest_axis(ways, std::span(order_).subspan(task.first, task.end - task.first));
    std::nth_element(order_.begin() + task.first, order_.begin() + middle, order_.begin() + task.end,
                     [&](std::uint32_t i, std::uint32_t j) {
                       return ways[i][axis] != ways[j][axis] ? ways[i][axis] < ways[j][axis] : i < j;
                     });
    tasks.push_back({middle, task.end, index});
    tasks.push_back({task.first, middle, kNone});
  }
  // Children come after their parents.
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    if (node.right != 0) {
      node.box = nodes_[i + 1].box;
      node.box.extend(nodes_[node.right].box);
    } else {
      for (std::uint32_t k = node.first; k < node.end; ++k) node.box.extend(boxes_[order_[k]]);
    }
  }
}

void MovingPairs::divide(const NodePair& pair, std::vector<NodePair>& open) const {
  const auto [a, b] = pair;
  if (a == b) {
    const std::uint32_t right = nodes_[a].right;
    open.insert(open.end(), {{right, right}, {a + 1, a + 1}, {a + 1, right}});
  } else if (nodes_[b].right == 0 || (nodes_[a].right != 0 && size_of(a) >= size_of(b))) {
    open.insert(open.end(), {{nodes_[a].right, b}, {a + 1, b}});
  } else {
    open.insert(open.end(), {{a, nodes_[b].right}, {a, b + 1}});
  }
}

void MovingPairs::for_each(const std::function<bool(std::uint32_t, std::uint32_t)>& visit) const {
  std::vector<NodePair> open;
  if (!nodes_.empty()) open.emplace_back(0, 0);
  while (!open.empty()) {
    poll_interruption();
    const NodePair pair = open.back();
    open.pop_back();
    const Node& a = nodes_[pair.first];
    const Node& b = nodes_[pair.second];
    if (pair.first != pair.second && a.box.is_apart_from(b.box)) continue;
    if (a.right != 0 || b.right != 0) {
      divide(pair, open);
      continue;
    }
    for (std::uint32_t k = a.first; k < a.end; ++k)
      for (std::uint32_t l = pair.first == pair.second ? k + 1 : b.first; l < b.end; ++l) {
        const std::uint32_t i = order_[k];
        const std::uint32_t j = order_[l];
        if (!boxes_[i].is_apart_from(boxes_[j]) && !visit(std::min(i, j), std::max(i, j))) return;
      }
  }
}

}  // namespace algebra3d
