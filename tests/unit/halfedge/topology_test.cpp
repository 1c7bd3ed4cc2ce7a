#include "algebra3d/kernel/halfedge/topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/audit.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "mesh_samples.h"

namespace algebra3d {
namespace {

using samples::BruteForce;
using samples::mesh_of;
using samples::Triangles;

std::vector<std::uint32_t> brute_components(const Triangles& triangles) {
  // Labels spread until nothing changes, then are numbered by first face.
  const BruteForce brute(triangles);
  std::vector<std::uint32_t> label(triangles.size());
  for (std::uint32_t f = 0; f < label.size(); ++f) label[f] = f;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [edge, along] : brute.edges()) {
      for (const std::uint32_t h : along) {
        const std::uint32_t lowest = std::min(label[along[0] / 3], label[h / 3]);
        changed = changed || label[along[0] / 3] != lowest || label[h / 3] != lowest;
        label[along[0] / 3] = label[h / 3] = lowest;
      }
    }
  }
  std::map<std::uint32_t, std::uint32_t> number;
  for (std::uint32_t& l : label) l = number.emplace(l, static_cast<std::uint32_t>(number.size())).first->second;
  return label;
}

TEST(Topology, components_are_those_of_brute_force) {
  for (const auto& triangles : samples::all_kinds()) {
    const FaceComponents components = connected_components(mesh_of(triangles));
    const auto expected = brute_components(triangles);
    ASSERT_EQ(components.of_face, expected);
    ASSERT_EQ(components.count, std::set(expected.begin(), expected.end()).size());
  }
}

TEST(Topology, common_edge_connects_and_common_vertex_does_not) {
  EXPECT_EQ(connected_components(mesh_of({{0, 1, 2}, {0, 3, 4}})).count, 2U);
  EXPECT_EQ(connected_components(mesh_of({{0, 1, 2}, {0, 1, 3}, {0, 1, 4}})).count, 1U);
}

TEST(Topology, faces_of_components_are_listed_in_order) {
  const auto faces = connected_components(mesh_of({{0, 1, 2}, {3, 4, 5}, {0, 2, 6}})).faces();
  ASSERT_EQ(faces.size(), 2U);
  EXPECT_EQ(faces[0], (std::vector<FaceId>{FaceId(0), FaceId(2)}));
  EXPECT_EQ(faces[1], std::vector<FaceId>{FaceId(1)});
}

TEST(Topology, boundary_loops_hold_each_boundary_halfedge_once_end_to_start) {
  for (const auto& triangles : samples::all_kinds()) {
    const TriangleMesh mesh = mesh_of(triangles);
    const BruteForce brute(triangles);
    std::multiset<std::uint32_t> met;
    for (const BoundaryLoop& loop : boundary_loops(mesh)) {
      ASSERT_FALSE(loop.halfedges.empty());
      for (std::size_t i = 0; i < loop.halfedges.size(); ++i) {
        met.insert(loop.halfedges[i].index());
        if (i > 0) {
          ASSERT_EQ(mesh.origin(loop.halfedges[i]), mesh.target(loop.halfedges[i - 1]));
        }
      }
      if (loop.is_closed) {
        ASSERT_EQ(mesh.origin(loop.halfedges.front()), mesh.target(loop.halfedges.back()));
        ASSERT_EQ(*std::ranges::min_element(loop.halfedges), loop.halfedges.front());
      }
    }
    std::multiset<std::uint32_t> expected;
    for (std::uint32_t h = 0; h < brute.halfedge_count(); ++h)
      if (brute.is_boundary(h)) expected.insert(h);
    ASSERT_EQ(met, expected);
  }
}

TEST(Topology, known_boundaries_have_their_loops) {
  EXPECT_TRUE(boundary_loops(mesh_of(samples::torus(4, 5))).empty());
  EXPECT_EQ(boundary_loops(mesh_of(samples::grid(4, 3, false, false))).size(), 1U);
  EXPECT_EQ(boundary_loops(mesh_of(samples::grid(4, 3, false, false)))[0].halfedges.size(), 14U);
  EXPECT_EQ(boundary_loops(mesh_of(samples::grid(4, 3, true, false))).size(), 2U);
}

TEST(Topology, triangles_that_touch_in_a_point_have_loops_of_their_own) {
  const auto loops = boundary_loops(mesh_of({{0, 1, 2}, {0, 3, 4}}));
  ASSERT_EQ(loops.size(), 2U);
  EXPECT_EQ(loops[0].halfedges, (std::vector<HalfedgeId>{HalfedgeId(0), HalfedgeId(1), HalfedgeId(2)}));
  EXPECT_EQ(loops[1].halfedges, (std::vector<HalfedgeId>{HalfedgeId(3), HalfedgeId(4), HalfedgeId(5)}));
}

TEST(Topology, boundary_that_ends_on_a_nonmanifold_edge_is_not_closed) {
  const auto loops = boundary_loops(mesh_of({{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}));
  ASSERT_EQ(loops.size(), 3U);
  for (const BoundaryLoop& loop : loops) {
    EXPECT_FALSE(loop.is_closed);
    EXPECT_EQ(loop.halfedges.size(), 2U);
  }
}

TEST(Topology, euler_characteristic_and_edges_are_counted) {
  EXPECT_EQ(euler_characteristic(mesh_of(samples::tetrahedron())), 2);
  EXPECT_EQ(euler_characteristic(mesh_of(samples::torus(4, 5))), 0);
  EXPECT_EQ(euler_characteristic(mesh_of(samples::double_torus())), -2);
  EXPECT_EQ(euler_characteristic(mesh_of(samples::grid(2, 2, false, false))), 1);
  EXPECT_EQ(euler_characteristic(mesh_of({{0, 1, 2}}, 10)), 1);
  EXPECT_EQ(euler_characteristic(mesh_of(samples::moebius_strip())), 0);
  for (const auto& triangles : samples::all_kinds())
    ASSERT_EQ(edge_count(mesh_of(triangles)), BruteForce(triangles).edges().size());
}

TEST(Topology, closed_manifold_and_oriented_are_told) {
  const TriangleMesh moebius = mesh_of(samples::moebius_strip());
  EXPECT_TRUE(is_closed(mesh_of(samples::torus(3, 4))));
  EXPECT_TRUE(is_closed(TriangleMesh()));
  EXPECT_FALSE(is_closed(mesh_of(samples::grid(1, 1, false, false))));
  EXPECT_TRUE(is_manifold(mesh_of(samples::grid(1, 1, false, false))));
  EXPECT_FALSE(is_manifold(mesh_of({{0, 1, 2}, {0, 3, 4}})));
  EXPECT_FALSE(is_manifold(moebius));
  EXPECT_FALSE(is_consistently_oriented(moebius));
  EXPECT_FALSE(is_consistently_oriented(mesh_of({{0, 1, 2}, {0, 1, 3}})));
  EXPECT_TRUE(is_consistently_oriented(mesh_of({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 0, 5}})));
  EXPECT_TRUE(is_consistently_oriented(mesh_of({{0, 1, 2}, {0, 3, 4}})));
}

/// By angles, of which those in one half-plane are equal: their tips are one direction times powers of two.
EdgeOrder order_by_angles(std::vector<std::pair<double, bool>> wings) {
  std::ranges::sort(wings);
  bool alternates = true;
  for (std::size_t i = 0; i < wings.size(); ++i) {
    const auto& next = wings[(i + 1) % wings.size()];
    if (wings[i].first == next.first) return EdgeOrder::overlapping;
    alternates = alternates && wings[i].second != next.second;
  }
  return alternates ? EdgeOrder::alternating : EdgeOrder::mixed;
}

TEST(Topology, order_around_an_edge_is_that_of_angles) {
  std::mt19937 random(5);
  std::map<EdgeOrder, int> counts;
  for (int round = 0; round < 3000; ++round) {
    const auto count = static_cast<std::uint32_t>(2 * (2 + random() % 3));  // as many run one way as the other
    std::vector<Vec3> points = {{0, 0, 0}, {0, 0, 1}};
    Triangles triangles;
    std::vector<std::pair<double, bool>> wings;
    for (std::uint32_t i = 0; i < count; ++i) {
      const double angle = static_cast<double>(random() % 12), far = std::ldexp(1, static_cast<int>(random() % 3));
      const bool is_forward = i < count / 2;
      points.push_back(far * Vec3{std::cos(angle), std::sin(angle), 0});
      if (is_forward)
        triangles.push_back({0, 1, i + 2});
      else
        triangles.push_back({1, 0, i + 2});
      wings.emplace_back(std::remainder(angle, 2 * std::numbers::pi), is_forward);
    }
    const TriangleMesh mesh(PointArray(std::move(points)), triangles);
    ASSERT_EQ(mesh.nonmanifold_edge_count(), 1U);
    const EdgeOrder order = order_around(mesh, mesh.nonmanifold_edge(0));
    EXPECT_EQ(order, order_by_angles(wings));
    ++counts[order];
  }
  EXPECT_EQ(counts.size(), 3U);
}

TEST(Topology, genus_of_known_surfaces_is_right) {
  EXPECT_EQ(*genus(TriangleMesh()), 0);
  EXPECT_EQ(*genus(mesh_of(samples::tetrahedron())), 0);
  EXPECT_EQ(*genus(mesh_of(samples::octahedron(), 20)), 0);
  EXPECT_EQ(*genus(mesh_of(samples::torus(5, 3))), 1);
  EXPECT_EQ(*genus(mesh_of(samples::double_torus())), 2);
  EXPECT_EQ(*genus(mesh_of(samples::joined(samples::double_torus(), samples::moved(samples::torus(3, 3), 40)))), 3);
}

TEST(Topology, genus_is_undefined_with_its_reason) {
  EXPECT_EQ(genus(mesh_of({{0, 1, 2}})).reason(), "no genus: boundary edges: 3");
  EXPECT_EQ(genus(mesh_of(samples::moebius_strip())).reason(), "no genus: non-manifold edges: 1");
  const TriangleMesh touching =
      mesh_of(samples::joined(samples::tetrahedron(), samples::moved(samples::tetrahedron(), 3)));
  EXPECT_EQ(genus(touching).reason(), "no genus: vertices where the surface touches itself: 1");
}

TEST(Topology, components_that_touch_in_a_vertex_have_a_genus_each) {
  const TriangleMesh mesh = mesh_of(samples::joined(
      samples::joined(samples::tetrahedron(), samples::moved(samples::torus(3, 4), 3)), {{50, 51, 52}}));
  const auto each = component_genus(mesh, connected_components(mesh));
  ASSERT_EQ(each.size(), 3U);
  EXPECT_EQ(*each[0], 0);
  EXPECT_EQ(*each[1], 1);
  EXPECT_EQ(each[2].reason(), "no genus: boundary edges: 3");
}

TEST(Topology, flipped_swaps_second_and_third_corner) {
  for (const auto& triangles : samples::all_kinds()) {
    const TriangleMesh mesh = flipped(mesh_of(triangles));
    ASSERT_TRUE(audit(mesh).empty());
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      const auto& [a, b, c] = triangles[f];
      ASSERT_EQ(mesh.triangle(FaceId(f)), (TriangleMesh::Triangle{a, c, b}));
    }
  }
}

TEST(Topology, submesh_keeps_the_order_of_faces_and_renumbers_by_first_use) {
  const TriangleMesh mesh = mesh_of(samples::octahedron());
  const std::vector<FaceId> faces{FaceId(7), FaceId(2)};
  const TriangleMesh part = submesh(mesh, faces);
  ASSERT_EQ(part.face_count(), 2U);
  ASSERT_EQ(part.vertex_count(), 5U);
  EXPECT_EQ(part.triangle(FaceId(0)), (TriangleMesh::Triangle{0, 1, 2}));
  EXPECT_EQ(part.triangle(FaceId(1)), (TriangleMesh::Triangle{3, 1, 4}));
  for (std::size_t f = 0; f < 2; ++f)
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(part.corners(FaceId(f))[i].approx, mesh.corners(faces[f])[i].approx);
  EXPECT_TRUE(audit(part).empty());
}

TEST(Topology, submesh_keeps_exact_points) {
  PointArray points;
  points.push_back(Vec3{0, 0, 0});
  points.push_back(Vec3{1, 0, 0});
  points.push_back(Vec3{0, 1, 0});
  points.push_back(ExactPoint(RationalVec3(Rational(1, 3), Rational(0), Rational(1))));
  const TriangleMesh mesh(std::move(points), Triangles{{0, 1, 2}, {3, 1, 0}});
  const std::vector<FaceId> faces{FaceId(1)};
  const TriangleMesh part = submesh(mesh, faces);
  EXPECT_EQ(part.vertex_count(), 3U);
  EXPECT_EQ(part.point(VertexId(0)).rational().x, Rational(1, 3));
}

}  // namespace
}  // namespace algebra3d
