#include "algebra3d/values/display/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/soup/spatial_order.h"
#include "algebra3d/values/display/detail/task_size.h"
#include "base/morton.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

/// Old and new numbers of positions.
struct Renumbering {
  std::vector<std::uint32_t> new_of_old, old_of_new;

  explicit Renumbering(std::size_t count) : new_of_old(count, kNone) { old_of_new.reserve(count); }

  void use(std::uint32_t position) {
    if (new_of_old[position] != kNone) return;
    new_of_old[position] = static_cast<std::uint32_t>(old_of_new.size());
    old_of_new.push_back(position);
  }
};

Renumbering numbered_by_use(const DrawnShape& shape) {
  Renumbering numbers(shape.positions.size());
  for (const IndexTriangle& triangle : shape.triangles)
    for (const std::uint32_t corner : triangle) numbers.use(corner);
  for (std::uint32_t i = 0; i < shape.positions.size(); ++i) numbers.use(i);
  return numbers;
}

template <typename Element>
void bring_into_order(LargeVector<Element>& elements, const Renumbering& numbers) {
  if (elements.empty()) return;
  LargeVector<Element> ordered(elements.size());
  parallel_for(elements.size(), detail::kElementsPerTask,
               [&](std::size_t i) { ordered[i] = elements[numbers.old_of_new[i]]; });
  elements = std::move(ordered);
}

template <typename Tuple>
void renumber(LargeVector<Tuple>& tuples, const Renumbering& numbers) {
  parallel_for(tuples.size(), detail::kElementsPerTask, [&](std::size_t i) {
    for (std::uint32_t& number : tuples[i]) number = numbers.new_of_old[number];
  });
}

/// Numbers the positions of a shape in the order in which its triangles use them first, and those that no triangle uses
/// after them; `vertex_ids` holds the numbers of their vertices in the value, except for levels of detail. Renderers
/// keep the last few vertices that they transformed, so neighbouring triangles should have near numbers [sander2007].
/// Cost: linear.
void number_positions_by_use(DrawnShape& shape) {
  const Renumbering numbers = numbered_by_use(shape);
  bring_into_order(shape.positions, numbers);
  bring_into_order(shape.normals, numbers);
  const bool is_level = shape.deviation.has_value();  // whose vertices have no numbers in the value
  if (shape.vertex_ids.empty() && !is_level)
    shape.vertex_ids.assign(numbers.old_of_new.begin(), numbers.old_of_new.end());
  else
    bring_into_order(shape.vertex_ids, numbers);
  for (auto* const lines : {&shape.edges, &shape.boundary, &shape.nonmanifold, &shape.lines}) renumber(*lines, numbers);
  renumber(shape.triangles, numbers);
  for (std::uint32_t& point : shape.points) point = numbers.new_of_old[point];
}

constexpr std::size_t kTrianglesPerBlock = 1024;

/// The highest eight bits for each axis of the Morton codes of the centres of triangles, on the grid of
/// `spatial_order`: for comparisons of blocks, of which at most 256 lie along an axis.
class CoarseCode {
 public:
  explicit CoarseCode(const DrawnShape& shape) : shape_(shape) {
    const Vec3 extent = shape.box.max - shape.box.min;
    const double largest = std::max({extent.x, extent.y, extent.z});
    half_ = 0.5 * extent;
    scale_ = largest > 0 ? kCells / largest : 0;
  }

  std::uint32_t operator()(const IndexTriangle& triangle) const {
    std::array<std::uint32_t, 3> cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (const std::uint32_t corner : triangle) sum += shape_.positions[corner][axis];
      cell[axis] = static_cast<std::uint32_t>(std::clamp((sum / 3 + half_[axis]) * scale_, 0.0, kCells - 1));
    }
    return static_cast<std::uint32_t>(morton_code(cell[0], cell[1], cell[2]));
  }

 private:
  static constexpr double kCells = 256;

  const DrawnShape& shape_;
  Vec3 half_;
  double scale_ = 0;
};

/// The codes of the triangles of a block but for the lowest and the highest sixteenth.
struct CodeRange {
  std::uint32_t low, high;
};

CodeRange code_range(const DrawnShape& shape, const CoarseCode& code_of, std::size_t block) {
  const std::size_t begin = block * kTrianglesPerBlock;
  const std::size_t end = std::min(begin + kTrianglesPerBlock, shape.triangles.size());
  std::vector<std::uint32_t> codes(end - begin);
  for (std::size_t i = begin; i < end; ++i) codes[i - begin] = code_of(shape.triangles[i]);
  const auto few = static_cast<std::ptrdiff_t>(codes.size() / 16);
  std::ranges::nth_element(codes, codes.begin() + few);
  const std::uint32_t low = codes[static_cast<std::size_t>(few)];
  std::ranges::nth_element(codes, codes.end() - 1 - few);
  return {low, *(codes.end() - 1 - few)};
}

/// True if triangles that follow one another lie together: most blocks of a thousand triangles come after the block
/// before them in Morton order of their centres, up to a few triangles. Cost: linear.
bool is_in_spatial_order(const DrawnShape& shape) {
  const CoarseCode code_of(shape);
  std::vector<CodeRange> ranges((shape.triangles.size() + kTrianglesPerBlock - 1) / kTrianglesPerBlock);
  parallel_for(ranges.size(), 16, [&](std::size_t block) { ranges[block] = code_range(shape, code_of, block); });
  std::size_t following = 0;
  for (std::size_t i = 1; i < ranges.size(); ++i)
    following += static_cast<std::size_t>(ranges[i - 1].high <= ranges[i].low);
  return 4 * following >= 3 * (ranges.size() - 1);
}

/// Permutes the triangles of a shape into Morton order unless they are in it already, and numbers the positions as they
/// are used then; `face_ids` and `vertex_ids` follow. Cost: linear.
void bring_into_spatial_order(DrawnShape& shape) {
  if (is_in_spatial_order(shape)) return;
  std::vector<Vec3> points(shape.positions.size());
  std::ranges::transform(shape.positions, points.begin(), [](const DrawnShape::Position& p) {
    return Vec3{p[0], p[1], p[2]};
  });
  const std::vector<std::uint32_t> order = spatial_order(points, shape.triangles);
  LargeVector<IndexTriangle> triangles(order.size());
  const bool is_level = shape.deviation.has_value();  // whose triangles have no numbers in the value
  LargeVector<std::uint32_t> face_ids(is_level ? 0 : order.size());
  parallel_for(order.size(), detail::kElementsPerTask, [&](std::size_t i) {
    triangles[i] = shape.triangles[order[i]];
    if (!is_level) face_ids[i] = shape.face_ids.empty() ? order[i] : shape.face_ids[order[i]];
  });
  shape.triangles = std::move(triangles);
  shape.face_ids = std::move(face_ids);
  number_positions_by_use(shape);
}

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
  bring_into_spatial_order(shape);
  const std::size_t leaf_count = (shape.triangles.size() + kTrianglesPerLeaf - 1) / kTrianglesPerLeaf;
  LargeVector<TreeNode> nodes(2 * leaf_count - 1);
  TreeMaker(shape, nodes).make(0, 0, leaf_count);
  shape.tree.resize(nodes.size() * sizeof(TreeNode));
  std::memcpy(shape.tree.data(), nodes.data(), shape.tree.size());
}

}  // namespace algebra3d
