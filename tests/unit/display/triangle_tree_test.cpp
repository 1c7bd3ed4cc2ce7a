#include "algebra3d/values/display/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "algebra3d/kernel/soup/spatial_order.h"
#include "base/scheduler.h"
#include "unit/display/values.h"

namespace algebra3d {
namespace {

/// Reads the nodes as three-mesh-bvh 0.9 does (nodeBufferUtils.js): by the number of a node, in words of 32 and 16
/// bits.
class TreeReader {
 public:
  explicit TreeReader(const DrawnShape& shape) : bytes_(shape.tree) {}

  std::size_t node_count() const { return bytes_.size() / 32; }
  bool is_leaf(std::size_t node) const { return half_word(node, 15) == 0xFFFF; }
  std::size_t offset(std::size_t node) const { return word<std::uint32_t>(node, 6); }
  std::size_t count(std::size_t node) const { return half_word(node, 14); }
  static std::size_t left(std::size_t node) { return node + 1; }
  std::size_t right(std::size_t node) const { return node + word<std::uint32_t>(node, 6); }
  std::size_t axis(std::size_t node) const { return word<std::uint32_t>(node, 7); }
  float bound(std::size_t node, std::size_t i) const { return word<float>(node, i); }

 private:
  template <typename Word>
  Word word(std::size_t node, std::size_t i) const {
    Word word;
    std::memcpy(&word, bytes_.data() + 32 * node + 4 * i, 4);
    return word;
  }
  std::uint16_t half_word(std::size_t node, std::size_t i) const {
    std::uint16_t word = 0;
    std::memcpy(&word, bytes_.data() + 32 * node + 2 * i, 2);
    return word;
  }

  const LargeVector<std::byte>& bytes_;
};

struct Ray {
  Vec3 from, along;
};

/// The distance at which a ray meets a triangle, or infinity. Source: Möller and Trumbore.
double hit(const DrawnShape& shape, std::size_t triangle, const Ray& ray) {
  const auto corner = [&](std::size_t i) {
    const auto& [x, y, z] = shape.positions[shape.triangles[triangle][i]];
    return Vec3{x, y, z};
  };
  const Vec3 u = corner(1) - corner(0), v = corner(2) - corner(0), p = cross(ray.along, v);
  const double det = dot(u, p);
  if (det == 0) return Box3::kInfinity;
  const Vec3 s = ray.from - corner(0), q = cross(s, u);
  const double a = dot(s, p) / det, b = dot(ray.along, q) / det, t = dot(v, q) / det;
  return a >= 0 && b >= 0 && a + b <= 1 && t > 0 ? t : Box3::kInfinity;
}

bool meets(const TreeReader& tree, std::size_t node, const Ray& ray) {
  double begin = 0, end = Box3::kInfinity;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double a = (tree.bound(node, axis) - ray.from[axis]) / ray.along[axis];
    const double b = (tree.bound(node, axis + 3) - ray.from[axis]) / ray.along[axis];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return begin <= end;
}

/// The first hit; counts the triangles that were looked at.
double first_hit(const DrawnShape& shape, const TreeReader& tree, const Ray& ray, std::size_t& looked_at) {
  double nearest = Box3::kInfinity;
  std::vector<std::size_t> stack{0};
  while (!stack.empty()) {
    const std::size_t node = stack.back();
    stack.pop_back();
    if (!meets(tree, node, ray)) continue;
    if (!tree.is_leaf(node)) {
      stack.push_back(tree.right(node));
      stack.push_back(TreeReader::left(node));
      continue;
    }
    for (std::size_t t = tree.offset(node); t < tree.offset(node) + tree.count(node); ++t) {
      ++looked_at;
      nearest = std::min(nearest, hit(shape, t, ray));
    }
  }
  return nearest;
}

/// A sphere with its triangles in random order, or in order along the meridians.
DrawnShape sphere_with_tree(bool is_shuffled) {
  DrawnShape shape = shape_of_solid(unit_sphere(60, 120));
  std::mt19937 random(1);
  if (is_shuffled) std::ranges::shuffle(shape.triangles, random);
  add_tree(shape);
  return shape;
}

TEST(TriangleTree, each_triangle_is_in_one_leaf_and_in_the_boxes_above_it) {
  for (const bool is_shuffled : {false, true}) {
    const DrawnShape shape = sphere_with_tree(is_shuffled);
    const TreeReader tree(shape);
    struct Waiting {
      std::size_t node, depth;
    };
    std::vector<Waiting> stack{{0, 1}};
    std::size_t nodes = 0, next = 0, deepest = 0;
    while (!stack.empty()) {
      const auto [node, depth] = stack.back();
      stack.pop_back();
      ++nodes;
      deepest = std::max(deepest, depth);
      if (tree.is_leaf(node)) {
        EXPECT_EQ(tree.offset(node), next) << "in the order of the leaves";
        ASSERT_TRUE(tree.count(node) >= 1 && tree.count(node) <= 16);
        for (; next < tree.offset(node) + tree.count(node); ++next)
          for (const std::uint32_t corner : shape.triangles[next])
            for (std::size_t axis = 0; axis < 3; ++axis) {
              EXPECT_LE(tree.bound(node, axis), shape.positions[corner][axis]);
              EXPECT_GE(tree.bound(node, axis + 3), shape.positions[corner][axis]);
            }
        continue;
      }
      EXPECT_LT(tree.axis(node), 3U);
      for (const std::size_t child : {tree.right(node), TreeReader::left(node)}) {
        ASSERT_LT(child, tree.node_count());
        stack.push_back({child, depth + 1});
        for (std::size_t axis = 0; axis < 3; ++axis) {
          EXPECT_LE(tree.bound(node, axis), tree.bound(child, axis));
          EXPECT_GE(tree.bound(node, axis + 3), tree.bound(child, axis + 3));
        }
      }
    }
    EXPECT_EQ(next, shape.triangles.size());
    EXPECT_EQ(nodes, tree.node_count());
    EXPECT_LE(deepest, 12U) << "about the logarithm of 884 leaves";
  }
}

TEST(TriangleTree, finds_the_first_hit_and_looks_at_few_triangles) {
  for (const bool is_shuffled : {false, true}) {
    const DrawnShape shape = sphere_with_tree(is_shuffled);
    const TreeReader tree(shape);
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    std::size_t looked_at = 0, hits = 0;
    constexpr std::size_t kRays = 300;
    for (std::size_t i = 0; i < kRays; ++i) {
      const Vec3 from{3 * normal(random), 3 * normal(random), 3 * normal(random)};
      const Ray ray{from, Vec3{normal(random), normal(random), normal(random)} - from};
      double expected = Box3::kInfinity;
      for (std::size_t t = 0; t < shape.triangles.size(); ++t) expected = std::min(expected, hit(shape, t, ray));
      EXPECT_EQ(first_hit(shape, tree, ray, looked_at), expected);
      hits += static_cast<std::size_t>(expected < Box3::kInfinity);
    }
    EXPECT_GT(hits, kRays / 4);
    EXPECT_LT(looked_at / kRays, shape.triangles.size() / 100);
  }
}

/// A sphere, and the same with its triangles in random order before it got its tree.
struct Reordered {
  DrawnShape before, after;

  Reordered() : before(shape_of_solid(unit_sphere(60, 120))), after(before) {
    std::mt19937 random(1);
    std::vector<std::uint32_t> order(before.triangles.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::shuffle(order, random);
    for (std::size_t i = 0; i < order.size(); ++i) after.triangles[i] = before.triangles[order[i]];
    after.face_ids.assign(order.begin(), order.end());
    add_tree(after);
  }
};

TEST(TriangleTree, ids_tell_triangles_and_vertices_that_were_moved) {
  const auto [before, after] = Reordered();
  ASSERT_TRUE(before.vertex_ids.empty());
  ASSERT_EQ(after.face_ids.size(), after.triangles.size());
  ASSERT_EQ(after.vertex_ids.size(), after.positions.size());
  for (std::size_t i = 0; i < after.triangles.size(); ++i) {
    IndexTriangle corners = after.triangles[i];
    for (std::uint32_t& corner : corners) corner = after.vertex_ids[corner];
    EXPECT_EQ(corners, before.triangles[after.face_ids[i]]);
  }
  for (std::size_t i = 0; i < after.positions.size(); ++i) {
    EXPECT_EQ(after.positions[i], before.positions[after.vertex_ids[i]]);
    EXPECT_EQ(after.normals[i], before.normals[after.vertex_ids[i]]);
  }
  ASSERT_EQ(after.edges.size(), before.edges.size());
  for (std::size_t i = 0; i < after.edges.size(); ++i)
    for (const std::size_t end : {0, 1}) EXPECT_EQ(after.vertex_ids[after.edges[i][end]], before.edges[i][end]);
}

TEST(TriangleTree, triangles_that_were_moved_use_their_positions_in_order) {
  const DrawnShape shape = Reordered().after;
  std::uint32_t used = 0;
  for (const IndexTriangle& triangle : shape.triangles)
    for (const std::uint32_t corner : triangle) {
      EXPECT_LE(corner, used);
      used = std::max(used, corner + 1);
    }
  EXPECT_EQ(used, shape.positions.size());
}

/// As imports store them; each side of the box has another length.
TEST(TriangleTree, triangles_in_spatial_order_stay_where_they_are) {
  const TriangleMesh sphere = unit_sphere(300, 400);
  std::vector<Vec3> points = sphere.points().approx();
  for (Vec3& p : points) p = {p.x, 0.3 * p.y, 0.77 * p.z};
  const TriangleMesh mesh(PointArray(std::move(points)), triangles_of(sphere));
  DrawnShape shape = shape_of_solid(in_spatial_order(mesh));
  const LargeVector<IndexTriangle> triangles = shape.triangles;
  add_tree(shape);
  EXPECT_EQ(shape.triangles, triangles);
  EXPECT_TRUE(shape.face_ids.empty());
  DrawnShape by_columns = shape_of_solid(mesh);
  add_tree(by_columns);
  EXPECT_FALSE(by_columns.face_ids.empty());
}

/// Its triangles are not those of the value, so they have no numbers there.
TEST(TriangleTree, a_coarser_level_that_is_reordered_gets_no_ids) {
  DrawnShape level = shape_of_solid(unit_sphere(60, 120));
  std::mt19937 random(1);
  std::ranges::shuffle(level.triangles, random);
  level.deviation = 0.1;
  add_tree(level);
  EXPECT_FALSE(level.tree.empty());
  EXPECT_TRUE(level.face_ids.empty());
  EXPECT_TRUE(level.vertex_ids.empty());
}

TEST(TriangleTree, small_shapes_have_none) {
  DrawnShape shape = shape_of_solid(cube_triangles(0, 1));
  add_tree(shape);
  EXPECT_TRUE(shape.tree.empty());
}

TEST(TriangleTree, does_not_depend_on_the_number_of_threads) {
  const DrawnShape shape = sphere_with_tree(true);
  with_threads(1, [&] { EXPECT_EQ(sphere_with_tree(true).tree, shape.tree); });
}

}  // namespace
}  // namespace algebra3d
