#include "algebra3d/kernel/halfedge/triangle_mesh.h"

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/audit.h"
#include "mesh_samples.h"

namespace algebra3d {
namespace {

using samples::BruteForce;

std::vector<std::uint32_t> indices(std::span<const HalfedgeId> halfedges) {
  std::vector<std::uint32_t> result;
  for (const HalfedgeId h : halfedges) result.push_back(h.index());
  return result;
}

TEST(TriangleMesh, default_mesh_is_empty) {
  const TriangleMesh mesh;
  EXPECT_TRUE(mesh.is_empty());
  EXPECT_EQ(mesh.vertex_count(), 0U);
  EXPECT_EQ(mesh.face_count(), 0U);
  EXPECT_EQ(mesh.nonmanifold_edge_count(), 0U);
  EXPECT_EQ(mesh.heap_bytes(), 0U);
}

TEST(TriangleMesh, default_handle_is_invalid) {
  EXPECT_FALSE(VertexId().is_valid());
  EXPECT_TRUE(VertexId(0).is_valid());
  EXPECT_LT(FaceId(3), FaceId(4));
}

TEST(TriangleMesh, halfedges_of_a_face_form_a_cycle) {
  for (std::uint32_t h = 0; h < 30; ++h) {
    const HalfedgeId handle(h);
    EXPECT_EQ(TriangleMesh::next(TriangleMesh::next(TriangleMesh::next(handle))), handle);
    EXPECT_EQ(TriangleMesh::prev(TriangleMesh::next(handle)), handle);
    EXPECT_EQ(TriangleMesh::face(TriangleMesh::next(handle)), FaceId(h / 3));
  }
}

TEST(TriangleMesh, triangles_are_kept_in_order) {
  for (const auto& triangles : samples::all_kinds()) {
    const TriangleMesh mesh = samples::mesh_of(triangles);
    ASSERT_EQ(mesh.face_count(), triangles.size());
    for (std::size_t f = 0; f < triangles.size(); ++f) ASSERT_EQ(mesh.triangle(FaceId(f)), triangles[f]);
  }
}

TEST(TriangleMesh, corners_of_a_face_are_its_points) {
  const TriangleMesh mesh = samples::mesh_of(samples::octahedron());
  const TriangleRef corners = mesh.corners(FaceId(1));
  EXPECT_EQ(corners[0].approx, (Vec3{2, 4, 8}));
  EXPECT_EQ(corners[1].approx, (Vec3{1, 1, 1}));
  EXPECT_EQ(corners[2].approx, (Vec3{4, 16, 64}));
}

TEST(TriangleMesh, edges_are_classified_as_brute_force_does) {
  for (const auto& triangles : samples::all_kinds()) {
    const TriangleMesh mesh = samples::mesh_of(triangles);
    const BruteForce expected(triangles);
    std::size_t nonmanifold_count = 0;
    for (const auto& [edge, along] : expected.edges())
      nonmanifold_count += !expected.is_boundary(along[0]) && !expected.is_manifold(along[0]) ? 1 : 0;
    ASSERT_EQ(mesh.nonmanifold_edge_count(), nonmanifold_count);
    for (std::uint32_t h = 0; h < expected.halfedge_count(); ++h) {
      const HalfedgeId handle(h);
      ASSERT_EQ(mesh.origin(handle).index(), expected.origin(h));
      ASSERT_EQ(mesh.target(handle).index(), expected.target(h));
      ASSERT_EQ(mesh.is_boundary(handle), expected.is_boundary(h));
      ASSERT_EQ(mesh.is_nonmanifold(handle), !expected.is_boundary(h) && !expected.is_manifold(h));
      ASSERT_EQ(mesh.opposite(handle), expected.is_manifold(h) ? HalfedgeId(expected.opposite(h)) : HalfedgeId());
      if (mesh.is_nonmanifold(handle)) {
        ASSERT_EQ(indices(mesh.edge_halfedges(handle)), expected.along(h));
      }
    }
  }
}

TEST(TriangleMesh, nonmanifold_edges_are_ordered_by_first_halfedge) {
  for (const auto& triangles : samples::all_kinds()) {
    const TriangleMesh mesh = samples::mesh_of(triangles);
    for (std::size_t n = 1; n < mesh.nonmanifold_edge_count(); ++n)
      ASSERT_LT(mesh.nonmanifold_edge(n - 1).front(), mesh.nonmanifold_edge(n).front());
  }
}

TEST(TriangleMesh, fans_are_those_of_brute_force) {
  for (const auto& triangles : samples::all_kinds()) {
    const TriangleMesh mesh = samples::mesh_of(triangles);
    const BruteForce expected(triangles);
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
      const auto fans = expected.fans(v);
      const auto listed = indices(mesh.fans(VertexId(v)));
      ASSERT_EQ(listed.size(), fans.size());
      ASSERT_TRUE(std::ranges::is_sorted(listed));
      ASSERT_EQ(mesh.is_nonmanifold(VertexId(v)), fans.size() > 1);
      ASSERT_EQ(mesh.is_isolated(VertexId(v)), fans.empty());
      ASSERT_EQ(mesh.outgoing(VertexId(v)), fans.empty() ? HalfedgeId() : HalfedgeId(listed[0]));
      for (const auto& fan : fans) {
        const auto start = std::ranges::find_if(listed, [&](std::uint32_t h) { return fan.contains(h); });
        ASSERT_NE(start, listed.end());
        const auto open = std::ranges::find_if(fan, [&](std::uint32_t h) { return !expected.is_manifold(h); });
        ASSERT_EQ(*start, open != fan.end() ? *open : *fan.begin());
      }
    }
  }
}

TEST(TriangleMesh, nonmanifold_vertices_are_listed_in_order) {
  for (const auto& triangles : samples::all_kinds()) {
    const TriangleMesh mesh = samples::mesh_of(triangles);
    const BruteForce brute(triangles);
    std::vector<VertexId> expected;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
      if (brute.fans(v).size() > 1) expected.emplace_back(v);
    ASSERT_EQ(mesh.nonmanifold_vertices(), expected);
  }
}

TEST(TriangleMesh, unused_points_are_isolated_vertices) {
  const TriangleMesh mesh = samples::mesh_of({{1, 2, 3}}, 6);
  EXPECT_EQ(mesh.vertex_count(), 6U);
  EXPECT_TRUE(mesh.is_isolated(VertexId(0)));
  EXPECT_TRUE(mesh.fans(VertexId(5)).empty());
  EXPECT_FALSE(mesh.outgoing(VertexId(0)).is_valid());
  EXPECT_TRUE(audit(mesh).empty());
}

TEST(TriangleMesh, halfedge_from_a_vertex_to_itself_is_nonmanifold) {
  const TriangleMesh mesh = samples::mesh_of({{0, 0, 1}});
  EXPECT_TRUE(mesh.is_nonmanifold(HalfedgeId(0)));
  EXPECT_EQ(mesh.edge_halfedges(HalfedgeId(0)).size(), 1U);
  EXPECT_EQ(mesh.opposite(HalfedgeId(1)), HalfedgeId(2));
}

TEST(TriangleMesh, hub_of_a_large_fan_is_linked) {
  samples::Triangles triangles;
  const std::uint32_t count = 5000;
  for (std::uint32_t i = 0; i < count; ++i) triangles.push_back({0, i + 1, (i + 1) % count + 1});
  const TriangleMesh mesh = samples::mesh_of(triangles);
  EXPECT_EQ(mesh.fans(VertexId(0)).size(), 1U);
  EXPECT_EQ(mesh.opposite(HalfedgeId(2)), HalfedgeId(3));
  EXPECT_TRUE(audit(mesh).empty());
}

TEST(TriangleMesh, exact_points_are_kept) {
  PointArray points;
  points.push_back(ExactPoint(RationalVec3(Rational(1, 3), Rational(0), Rational(0))));
  points.push_back(Vec3{1, 0, 0});
  points.push_back(Vec3{0, 1, 0});
  const TriangleMesh mesh(std::move(points), std::vector<TriangleMesh::Triangle>{{0, 1, 2}});
  EXPECT_EQ(mesh.point(VertexId(0)).rational().x, Rational(1, 3));
  EXPECT_TRUE(mesh.point(VertexId(1)).is_double());
}

TEST(TriangleMesh, copy_and_move_keep_everything) {
  const auto triangles = samples::joined(samples::tetrahedron(), samples::moved(samples::tetrahedron(), 3));
  TriangleMesh mesh = samples::mesh_of(triangles);
  const TriangleMesh copy = mesh;
  const TriangleMesh moved = std::move(mesh);
  for (const TriangleMesh* each : {&copy, &moved}) {
    EXPECT_TRUE(audit(*each).empty());
    EXPECT_EQ(each->fans(VertexId(3)).size(), 2U);
    EXPECT_EQ(each->face_count(), 8U);
  }
}

}  // namespace
}  // namespace algebra3d
