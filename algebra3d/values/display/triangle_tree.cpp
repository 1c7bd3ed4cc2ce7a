#include "algebra3d/values/display/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/values/display/detail/triangle_order.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

constexpr std::size_t kTrianglesPerLeaf = 16;

struct TreeNode {
  std::array<float, 3> min, max;
  std::uint32_t first_or_distance;  // of a leaf its first triangle, else the distance to the right child
  std::uint32_t axis_or_count;      // of a leaf the number of triangles, with kLeaf, else the axis

  static constexpr std::uint32_t kLeaf = 0xFFFF0000;
};
static_assert(sizeof(TreeNode) == 32);

/// Fills the nodes of a tree. A subtree with n leaves has 2n - 1 nodes, so their places are known beforehand.
class TreeMaker {
 public:
  TreeMaker(const DrawnShape& shape, std::span<TreeNode> nodes) : shape_(shape), nodes_(nodes) {}

  /// The subtree of some leaves, from `node` on. The depth of the recursion is the logarithm of their number.
  void make(std::size_t node, std::size_t first_leaf, std::size_t leaf_count) {
    if (leaf_count == 1) {
      make_leaf(nodes_[node], first_leaf);
      return;
    }
    constexpr std::size_t kLeavesPerTask = 1024;
    const std::size_t left_count = leaf_count / 2, left = node + 1, right = node + 2 * left_count;
    parallel_invoke(
        leaf_count > kLeavesPerTask, [&] { make(left, first_leaf, left_count); },
        [&] { make(right, first_leaf + left_count, leaf_count - left_count); });
    join(nodes_[node], nodes_[left], nodes_[right]);
    nodes_[node].first_or_distance = static_cast<std::uint32_t>(right - node);
  }

 private:
  void make_leaf(TreeNode& node, std::size_t leaf) const {
    const std::size_t first = leaf * kTrianglesPerLeaf;
    const std::size_t end = std::min(first + kTrianglesPerLeaf, shape_.triangles.size());
    node.min.fill(std::numeric_limits<float>::infinity());
    node.max.fill(-std::numeric_limits<float>::infinity());
    for (std::size_t t = first; t < end; ++t)
      for (const std::uint32_t corner : shape_.triangles[t])
        for (std::size_t axis = 0; axis < 3; ++axis) {
          node.min[axis] = std::min(node.min[axis], shape_.positions[corner][axis]);
          node.max[axis] = std::max(node.max[axis], shape_.positions[corner][axis]);
        }
    // A ray is compared with boxes in rounded numbers.
    constexpr float kMargin = 0x1p-23F;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.min[axis] -= kMargin * std::abs(node.min[axis]);
      node.max[axis] += kMargin * std::abs(node.max[axis]);
    }
    node.first_or_distance = static_cast<std::uint32_t>(first);
    node.axis_or_count = TreeNode::kLeaf | static_cast<std::uint32_t>(end - first);
  }

  /// The box around two nodes, and the axis along which the second lies farthest behind the first.
  static void join(TreeNode& node, const TreeNode& left, const TreeNode& right) {
    float farthest = -std::numeric_limits<float>::infinity();
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      node.min[axis] = std::min(left.min[axis], right.min[axis]);
      node.max[axis] = std::max(left.max[axis], right.max[axis]);
      const float distance = (right.min[axis] - left.min[axis]) + (right.max[axis] - left.max[axis]);
      if (distance > farthest) {
        farthest = distance;
        node.axis_or_count = axis;
      }
    }
  }

  const DrawnShape& shape_;
  std::span<TreeNode> nodes_;
};

}  // namespace

void add_tree(DrawnShape& shape) {
  if (shape.triangles.size() < kLeastTrianglesOfTree) return;
  detail::bring_into_spatial_order(shape);
  const std::size_t leaf_count = (shape.triangles.size() + kTrianglesPerLeaf - 1) / kTrianglesPerLeaf;
  LargeVector<TreeNode> nodes(2 * leaf_count - 1);
  TreeMaker(shape, nodes).make(0, 0, leaf_count);
  shape.tree.resize(nodes.size() * sizeof(TreeNode));
  std::memcpy(shape.tree.data(), nodes.data(), shape.tree.size());
}

}  // namespace algebra3d
