#include "algebra3d/kernel/halfedge/edge_balance.h"

#include <vector>

#include <gtest/gtest.h>

namespace algebra3d {
namespace {

using Triangles = std::vector<TriangleMesh::Triangle>;

const std::vector<Vec3> kCorners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};

TriangleMesh mesh_at_corners(const Triangles& triangles) {
  return {PointArray(kCorners), triangles};
}

bool are_balanced(const TriangleMesh& a, const TriangleMesh& b) {
  EdgeBalance balance;
  balance.add(a, 1);
  balance.add(b, -1);
  return balance.is_zero();
}

TEST(EdgeBalance, is_that_of_the_boundary) {
  const TriangleMesh flat = mesh_at_corners({{0, 1, 2}, {0, 2, 3}}),
                     other_diagonal = mesh_at_corners({{0, 1, 3}, {1, 2, 3}});
  const TriangleMesh tent = mesh_at_corners({{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  EXPECT_TRUE(are_balanced(flat, other_diagonal));
  EXPECT_TRUE(are_balanced(flat, tent));
  EXPECT_FALSE(are_balanced(flat, mesh_at_corners({{0, 1, 2}})));
  EXPECT_FALSE(are_balanced(flat, mesh_at_corners({{0, 2, 1}, {0, 3, 2}})));
  EXPECT_TRUE(are_balanced(TriangleMesh(), TriangleMesh()));
}

// Vertices of the same place are one, and edges with any number of faces count.
TEST(EdgeBalance, tells_places_and_not_vertices) {
  const TriangleMesh flat = mesh_at_corners({{0, 1, 2}, {0, 2, 3}});
  std::vector<Vec3> twice = kCorners;
  twice.insert(twice.end(), kCorners.begin(), kCorners.end());
  EXPECT_TRUE(are_balanced(flat, TriangleMesh(PointArray(twice), Triangles{{0, 1, 2}, {5, 7, 8}})));
  EXPECT_TRUE(are_balanced(flat, mesh_at_corners({{0, 1, 2}, {0, 2, 3}, {0, 2, 4}, {2, 0, 4}})));
  EXPECT_FALSE(are_balanced(flat, mesh_at_corners({{0, 1, 2}, {0, 2, 3}, {0, 2, 4}})));
}

TEST(EdgeBalance, counts_single_halfedges) {
  const TriangleMesh face = mesh_at_corners({{0, 1, 2}});
  EdgeBalance balance;
  EXPECT_TRUE(balance.is_zero());
  balance.add(face, HalfedgeId(0), 2);
  EXPECT_FALSE(balance.is_zero());
  balance.add(face, HalfedgeId(0), -2);
  EXPECT_TRUE(balance.is_zero());
}

}  // namespace
}  // namespace algebra3d
