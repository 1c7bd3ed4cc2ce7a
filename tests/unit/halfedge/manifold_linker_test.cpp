// Meshes linked in one pass beside the same linked by sorting: a mesh with all half-edges given as unlinked is sorted.
#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "mesh_samples.h"
#include "same_mesh.h"

namespace algebra3d {
namespace {

using samples::Triangles;

void expect_linked_as_sorted(const Triangles& triangles, std::size_t vertex_count) {
  LargeVector<std::uint32_t> origins;
  for (const auto& triangle : triangles) origins.insert(origins.end(), triangle.begin(), triangle.end());
  const LargeVector<std::uint32_t> opposites(origins.size(), TriangleMesh::kUnlinked);
  const PointArray points = samples::points_for(vertex_count);
  samples::expect_same_mesh(TriangleMesh(points, triangles), TriangleMesh(points, origins, opposites, {}));
}

TEST(ManifoldLinker, any_few_triangles) {
  std::mt19937 random(3);
  for (int i = 0; i < 4000; ++i) {
    const std::uint32_t vertex_count = static_cast<std::uint32_t>(3 + random() % 5);
    Triangles triangles(1 + random() % 12);
    for (auto& triangle : triangles)
      for (std::uint32_t& corner : triangle) corner = static_cast<std::uint32_t>(random() % vertex_count);
    expect_linked_as_sorted(triangles, vertex_count);
  }
}

/// Each half-edge finds an opposite one, whatever the order: only the vertices tell that the edge has four.
TEST(ManifoldLinker, two_tetrahedra_at_one_edge) {
  const Triangles both{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 4, 1}, {0, 1, 5}, {1, 4, 5}, {4, 0, 5}};
  std::mt19937 random(4);
  for (int i = 0; i < 200; ++i) {
    Triangles triangles = both;
    std::ranges::shuffle(triangles, random);
    expect_linked_as_sorted(triangles, 6);
    EXPECT_EQ(TriangleMesh(samples::points_for(6), triangles).nonmanifold_edge_count(), 1U);
  }
}

TEST(ManifoldLinker, large_fans_in_order_and_in_disorder) {
  std::mt19937 random(5);
  for (const std::uint32_t count : {15U, 16U, 17U, 40U, 400U}) {
    Triangles triangles;
    for (std::uint32_t i = 0; i < count; ++i) triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
    expect_linked_as_sorted(triangles, count + 1);
    std::ranges::shuffle(triangles, random);
    expect_linked_as_sorted(triangles, count + 1);
    triangles.push_back({0, 1, 1 + count / 2});  // two more edges at the hub that have too many
    expect_linked_as_sorted(triangles, count + 1);
  }
}

TEST(ManifoldLinker, vertices_of_several_fans) {
  const Triangles closed = samples::joined(samples::tetrahedron(), {{0, 5, 4}, {0, 4, 6}, {0, 6, 5}, {4, 5, 6}});
  expect_linked_as_sorted(closed, 7);
  expect_linked_as_sorted({{0, 1, 2}, {0, 3, 4}}, 5);
  expect_linked_as_sorted(samples::joined(samples::tetrahedron(), {{0, 4, 5}}), 6);
}

}  // namespace
}  // namespace algebra3d
