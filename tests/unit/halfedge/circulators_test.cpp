#include "algebra3d/kernel/halfedge/circulators.h"

#include <gtest/gtest.h>

#include "mesh_samples.h"

namespace algebra3d {
namespace {

using samples::BruteForce;

/// Indices of the handles in `range`, in its order.
template <typename Range>
std::vector<std::uint32_t> indices(Range&& range) {
  std::vector<std::uint32_t> result;
  for (const auto handle : range) result.push_back(handle.index());
  return result;
}

template <typename Range>
std::vector<std::uint32_t> sorted_indices(Range&& range) {
  auto result = indices(std::forward<Range>(range));
  std::ranges::sort(result);
  return result;
}

std::uint32_t before(std::uint32_t h) {
  return 3 * (h / 3) + (h % 3 + 2) % 3;
}

template <typename Test>
void for_each_vertex_of_all_kinds(Test test) {
  for (const auto& triangles : samples::all_kinds()) {
    const TriangleMesh mesh = samples::mesh_of(triangles);
    const BruteForce brute(triangles);
    for (std::uint32_t v = 0; v < mesh.vertex_count() && !testing::Test::HasFatalFailure(); ++v)
      test(mesh, VertexId(v), brute);
  }
}

TEST(Circulators, outgoing_halfedges_are_all_that_leave_the_vertex_each_once) {
  for_each_vertex_of_all_kinds([](const TriangleMesh& mesh, VertexId v, const BruteForce& brute) {
    ASSERT_EQ(sorted_indices(outgoing_halfedges(mesh, v)), brute.corners(v.index()));
  });
}

TEST(Circulators, outgoing_halfedges_go_counter_clockwise_fan_by_fan) {
  for_each_vertex_of_all_kinds([](const TriangleMesh& mesh, VertexId v, const BruteForce& brute) {
    const auto starts = mesh.fans(v);
    std::size_t fan = 0;
    std::uint32_t last = 0;
    for (const HalfedgeId h : outgoing_halfedges(mesh, v)) {
      if (fan < starts.size() && h == starts[fan]) {
        ++fan;
      } else {
        ASSERT_TRUE(brute.is_manifold(before(last)));
        ASSERT_EQ(h.index(), brute.opposite(before(last)));
      }
      last = h.index();
    }
    ASSERT_EQ(fan, starts.size());
  });
}

TEST(Circulators, faces_around_a_vertex_are_met_once_per_corner) {
  for_each_vertex_of_all_kinds([](const TriangleMesh& mesh, VertexId v, const BruteForce& brute) {
    std::vector<std::uint32_t> expected;
    for (const std::uint32_t h : brute.corners(v.index())) expected.push_back(h / 3);
    ASSERT_EQ(sorted_indices(faces_around(mesh, v)), expected);
  });
}

TEST(Circulators, adjacent_vertices_are_the_ends_of_all_edges) {
  for_each_vertex_of_all_kinds([](const TriangleMesh& mesh, VertexId v, const BruteForce& brute) {
    std::multiset<std::uint32_t> expected;
    for (const auto& [edge, along] : brute.edges()) {
      if (edge.first != v.index() && edge.second != v.index()) continue;
      const std::uint32_t other = edge.first == v.index() ? edge.second : edge.first;
      // Every half-edge of a non-manifold edge bounds a fan of its own; from v to v, at both of its ends.
      const bool once = brute.is_boundary(along[0]) || brute.is_manifold(along[0]);
      const std::size_t times = once ? 1 : other == v.index() ? 2 * along.size() : along.size();
      for (std::size_t i = 0; i < times; ++i) expected.insert(other);
    }
    const auto ring = sorted_indices(adjacent_vertices(mesh, v));
    ASSERT_EQ(ring, std::vector(expected.begin(), expected.end()));
  });
}

TEST(Circulators, neighbours_of_a_manifold_vertex_are_met_once) {
  for (const auto& triangles : {samples::octahedron(), samples::torus(5, 7), samples::grid(4, 3, false, false)}) {
    const TriangleMesh mesh = samples::mesh_of(triangles);
    const BruteForce brute(triangles);
    for (const VertexId v : vertices(mesh)) {
      std::set<std::uint32_t> expected;
      for (std::uint32_t h = 0; h < brute.halfedge_count(); ++h) {
        if (brute.origin(h) == v.index()) expected.insert(brute.target(h));
        if (brute.target(h) == v.index()) expected.insert(brute.origin(h));
      }
      ASSERT_EQ(sorted_indices(adjacent_vertices(mesh, v)), std::vector(expected.begin(), expected.end()));
    }
  }
}

TEST(Circulators, one_ring_of_a_known_boundary_vertex_is_counter_clockwise) {
  const TriangleMesh mesh = samples::mesh_of({{0, 2, 3}, {0, 1, 2}, {0, 3, 4}});
  EXPECT_EQ(indices(adjacent_vertices(mesh, VertexId(0))), (std::vector<std::uint32_t>{1, 2, 3, 4}));
  EXPECT_EQ(indices(faces_around(mesh, VertexId(0))), (std::vector<std::uint32_t>{1, 0, 2}));
}

TEST(Circulators, halfedges_and_vertices_of_a_face_start_at_corner_0) {
  const TriangleMesh mesh = samples::mesh_of(samples::octahedron());
  EXPECT_EQ(indices(halfedges_of(mesh, FaceId(2))), (std::vector<std::uint32_t>{6, 7, 8}));
  EXPECT_EQ(indices(vertices_of(mesh, FaceId(2))), (std::vector<std::uint32_t>{1, 3, 4}));
}

TEST(Circulators, adjacent_faces_are_those_that_share_an_edge) {
  for (const auto& triangles : samples::all_kinds()) {
    const TriangleMesh mesh = samples::mesh_of(triangles);
    const BruteForce brute(triangles);
    for (const FaceId f : faces(mesh)) {
      std::vector<std::uint32_t> expected;
      for (std::uint32_t h = 3 * f.index(); h < 3 * f.index() + 3; ++h)
        for (const std::uint32_t other : brute.along(h))
          if (other / 3 != f.index()) expected.push_back(other / 3);
      ASSERT_EQ(indices(adjacent_faces(mesh, f)), expected);
    }
  }
}

TEST(Circulators, edges_are_met_once_by_their_first_halfedge) {
  for (const auto& triangles : samples::all_kinds()) {
    const TriangleMesh mesh = samples::mesh_of(triangles);
    const BruteForce brute(triangles);
    std::set<std::uint32_t> expected;
    for (const auto& [edge, along] : brute.edges()) expected.insert(along.front());
    ASSERT_EQ(indices(edges(mesh)), std::vector(expected.begin(), expected.end()));
  }
}

TEST(Circulators, elements_are_met_in_order) {
  const TriangleMesh mesh = samples::mesh_of(samples::tetrahedron());
  EXPECT_EQ(indices(vertices(mesh)), (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(indices(faces(mesh)), (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(halfedges(mesh).size(), 12U);
  EXPECT_EQ(faces(mesh)[2], FaceId(2));
}

TEST(Circulators, neighbourhoods_of_an_isolated_vertex_are_empty) {
  const TriangleMesh mesh = samples::mesh_of({{0, 1, 2}}, 4);
  EXPECT_TRUE(outgoing_halfedges(mesh, VertexId(3)).empty());
  EXPECT_TRUE(adjacent_vertices(mesh, VertexId(3)).empty());
  EXPECT_TRUE(faces_around(mesh, VertexId(3)).empty());
}

TEST(Circulators, ranges_compose_with_views) {
  const TriangleMesh mesh = samples::mesh_of(samples::octahedron());
  const auto is_even = [](VertexId v) { return v.index() % 2 == 0; };
  EXPECT_EQ(sorted_indices(adjacent_vertices(mesh, VertexId(0)) | std::views::filter(is_even)),
            (std::vector<std::uint32_t>{2, 4}));
  const auto valence = [&](VertexId v) { return std::ranges::distance(outgoing_halfedges(mesh, v)); };
  for (const auto each : vertices(mesh) | std::views::transform(valence)) EXPECT_EQ(each, 4);
  EXPECT_EQ(std::ranges::distance(vertices(mesh) | std::views::reverse | std::views::take(2)), 2);
}

TEST(Circulators, iterators_outlive_their_range) {
  const TriangleMesh mesh = samples::mesh_of(samples::octahedron());
  const auto found = std::ranges::find(adjacent_vertices(mesh, VertexId(0)), VertexId(5));
  EXPECT_EQ(*found, VertexId(5));
}

}  // namespace
}  // namespace algebra3d
