#include "algebra3d/kernel/repair/detail/missing_halfedges.h"

#include <utility>

#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

TriangleMesh mesh_over(std::vector<Vec3> points, const std::vector<IndexTriangle>& triangles) {
  return {PointArray(std::move(points)), triangles};
}

std::vector<Edge> edges_of(const MissingHalfedges& missing) {
  std::vector<Edge> edges;
  for (const MissingHalfedge& edge : missing.edges) edges.emplace_back(edge.from.index(), edge.to.index());
  return edges;
}

const std::vector<Vec3> kBook{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}};

TEST(MissingHalfedges, of_a_triangle_run_around_it_the_other_way) {
  const TriangleMesh mesh = mesh_over({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const MissingHalfedges missing(mesh);
  EXPECT_EQ(edges_of(missing), (std::vector<Edge>{{1, 0}, {2, 1}, {0, 2}}));
  EXPECT_TRUE(missing.has_boundary);
  EXPECT_FALSE(missing.has_nonmanifold);
  EXPECT_EQ(missing.shortest_loop(MissingId(0), mesh.points().approx()),
            (std::vector<MissingId>{MissingId(0), MissingId(2), MissingId(1)}));
  EXPECT_EQ(missing.find(VertexId(2), VertexId(1)), MissingId(1));
  EXPECT_TRUE(missing.find(VertexId(1), VertexId(2)).is_none());
}

TEST(MissingHalfedges, of_a_closed_mesh_are_none) {
  const MissingHalfedges missing(solids::cube(0, 1));
  EXPECT_TRUE(missing.edges.empty());
  EXPECT_FALSE(missing.has_boundary);
  EXPECT_FALSE(missing.has_nonmanifold);
}

// Three pages at the edge from 0 to 1, of which two run forward and one backward: one half-edge back is missing.
TEST(MissingHalfedges, of_a_nonmanifold_edge_are_what_one_direction_has_more) {
  const MissingHalfedges missing(mesh_over(kBook, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  EXPECT_TRUE(missing.has_nonmanifold);
  const MissingId back = missing.find(VertexId(1), VertexId(0));
  ASSERT_FALSE(back.is_none());
  EXPECT_FALSE(missing.edges[back].is_boundary);
  EXPECT_EQ(missing.edges.size(), 7U);  // and two of each page
  for (const MissingHalfedge& edge : missing.edges) {
    EXPECT_TRUE(!edge.is_boundary || edge.ends_at_interface);
  }
}

// With all three pages running forward, three are missing; loops over the boundary alone do not use them.
TEST(MissingHalfedges, loops_over_boundary_edges_avoid_others) {
  const TriangleMesh mesh = mesh_over(kBook, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  const MissingHalfedges missing(mesh);
  std::size_t back_count = 0;
  for (const Edge& edge : edges_of(missing)) back_count += edge == Edge(1, 0) ? 1 : 0;
  EXPECT_EQ(back_count, 3U);
  const MissingId boundary = missing.find(VertexId(2), VertexId(1));
  ASSERT_FALSE(boundary.is_none());
  EXPECT_EQ(missing.shortest_loop(boundary, mesh.points().approx()).size(), 3U);
  EXPECT_TRUE(missing.shortest_loop(boundary, mesh.points().approx(), MissingHalfedges::Way::boundary).empty());
}

TEST(MissingHalfedges, chords_join_their_ends_and_lack_nothing) {
  // A square of two triangles: its diagonal becomes a chord, both ways.
  const TriangleMesh mesh = mesh_over({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  MissingHalfedges missing(mesh);
  EXPECT_EQ(missing.edges.size(), 4U);
  missing.add_chords(mesh);
  EXPECT_EQ(missing.edges.size(), 6U);
  EXPECT_TRUE(missing.find(VertexId(0), VertexId(2)).is_none());
  EXPECT_EQ(missing.shortest_loop(MissingId(0), mesh.points().approx()).size(), 3U);
}

}  // namespace
}  // namespace algebra3d::soups
